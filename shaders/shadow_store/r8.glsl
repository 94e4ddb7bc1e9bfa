// shadow_store=r8: 8-bit distance: beyond the range it is clamped to 0.
#include "shadow_store/distance.glsl"
