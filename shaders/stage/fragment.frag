// stage=fragment: lit here.
VARYING_IN P_VARYING vec3 v_position;
VARYING_IN P_VARYING vec3 v_normal;

#include "lighting.glsl"
#include "normalise/$(NORMALISE).glsl"

Shade shade_here()
{
    return shade_surface(v_position, surface_normal(v_normal));
}
