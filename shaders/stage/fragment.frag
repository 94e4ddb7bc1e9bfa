// stage=fragment: lit here.
GIVEN_INPUT P_VARYING vec3 v_position;
GIVEN_INPUT P_VARYING vec3 v_normal;
WITH_NORMAL_MAP(GIVEN_INPUT P_VARYING vec3 v_tangent;)
WITH_NORMAL_MAP(GIVEN_INPUT P_VARYING vec3 v_bitangent;)

#include "unit.glsl"
#include "normalise/$(NORMALISE).glsl"
#include "lighting.glsl"
#include "frame.glsl"

P_VECTOR vec3 shading_normal(P_VECTOR vec3 normal)
{
    WITH_NORMAL_MAP(P_VECTOR vec3 bump;)
    IF_NORMAL_MAP(bump = normal_map(v_uv);)
    IF_NORMAL_MAP(normal = normal_in_frame(normal, v_tangent, v_bitangent, bump);)
    return normal;
}

Shade shade_here()
{
    PROBE_INPUTS(v_position, v_normal, v_uv)
    IF_NORMAL_MAP(PROBE_FRAME(v_tangent, v_bitangent))
    return shade_surface(v_position, shading_normal(surface_normal(v_normal)));
}
