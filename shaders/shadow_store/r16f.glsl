// shadow_store=r16f: half-float distance.
#include "shadow_store/distance.glsl"
