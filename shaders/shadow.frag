// Fragment shader of the program "shadow": stores how far the surface is from the light.
#include "version/$(GLSL_FAMILY).glsl"

#include "shadow_distance/$(F_SHADOW).glsl"

in P_VARYING CARRIED v_carried;

uniform P_UNIFORM float u_light_range;

#include "shadow_store/$(SHADOW_STORE).glsl"

DECLARE_O_STORED

void main()
{
    P_ATTENUATION float range = u_light_range;
    STORE(carried_distance(v_carried), range)
}
