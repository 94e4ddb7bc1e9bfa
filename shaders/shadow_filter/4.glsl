// shadow_filter=4: four taps, half a texel to each side.
#define SHADOW_TAPS 2
#include "shadow_filter/grid.glsl"
