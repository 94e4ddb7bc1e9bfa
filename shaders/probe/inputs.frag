// PROBE=inputs, in fragment shaders of either stage.
#include "probe/texels.glsl"
