// stage=vertex: lit here, and the result is interpolated (Gouraud 1971). Diffuse and specular
// light go apart, because the maps that multiply them differ.
VARYING_OUT P_VARYING vec3 v_diffuse;
VARYING_OUT P_VARYING vec3 v_specular;

#include "lighting.glsl"

void hand_over(highp vec3 position, highp vec3 normal)
{
    PROBE_INPUTS(position, normal, a_uv)
    Shade shade = shade_surface(position, normal);
    v_diffuse = shade.diffuse;
    v_specular = shade.specular;
}
