// shadow_store=r8: 8-bit distance.
#include "shadow_store/distance.glsl"
