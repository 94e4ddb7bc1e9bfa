// stage=vertex: lit in the vertex shader.
VARYING_IN P_VARYING vec3 v_diffuse;
VARYING_IN P_VARYING vec3 v_specular;

#include "surface.glsl"

Shade shade_here()
{
    return Shade(v_diffuse, v_specular);
}
