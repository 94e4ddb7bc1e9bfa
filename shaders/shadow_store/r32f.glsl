// shadow_store=r32f: float distance.
#include "shadow_store/distance.glsl"
