// shadow_filter=16: sixteen taps, half a texel and one and a half to each side.
#define SHADOW_TAPS 4
#include "shadow_filter/grid.glsl"
