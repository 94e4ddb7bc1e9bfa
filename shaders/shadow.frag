// Fragment shader of the program "shadow": stores how far the surface is from the light. The
// vector is interpolated and its length taken here: a distance is not linear over a triangle.
#include "version/$(GLSL_FAMILY).glsl"

in P_VARYING vec3 v_position;

uniform P_UNIFORM vec3 u_light_position; // world space
uniform P_UNIFORM float u_light_range;

#include "shadow_store/$(SHADOW_STORE).glsl"

DECLARE_O_STORED

void main()
{
    P_POSITION vec3 light_position = u_light_position;
    P_POSITION vec3 position = v_position;
    P_ATTENUATION float range = u_light_range;
    STORE(light_position - position, range)
}
