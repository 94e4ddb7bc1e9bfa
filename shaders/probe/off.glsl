// PROBE=off: nothing is told, and the driver sees nothing of it.
#include "probe/untold.glsl"

#define PROBE_INPUTS(position, normal, uv)
#define PROBE_FRAME(tangent, bitangent)
#define PROBE_OUT
