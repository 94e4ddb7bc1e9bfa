// Shadows of the first NR_SHADOWS point lights. One entry:
//     float caster_visibility(caster, PointLight light, vec3 to_light, float n_dot_l)
// the share of the taps that the light reaches, 0 to 1; to_light: world space, from the surface
// to the light. EACH_CASTER(one) is one(0) one(1) ... for all casters: each kind of map says
// whether the number of a caster must be a constant, as the index into an array of samplers
// must in GLSL 3.30 (4.1.7) and GLSL ES 3.00 (12.29).
#if NR_SHADOWS > 0
#include "shadow_store/$(SHADOW_STORE).glsl"
#include "shadow_map/$(SHADOW_MAP).glsl"
#include "shadow_filter/$(SHADOW_FILTER).glsl"
#include "shadow_bias_kind/$(SHADOW_BIAS_KIND).glsl"

P_ATTENUATION float shadow_share(SHADOW_MAP_PARAMETERS, PointLight light,
                                 P_POSITION vec3 to_light, P_VECTOR float n_dot_l)
{
    P_ATTENUATION float range = light.range;
    P_POSITION float reference = shadow_reference(to_light, range, shadow_bias(n_dot_l));
    return shadow_filter(SHADOW_MAP_ARGUMENTS, -to_light, reference);
}

#define caster_visibility(i, light, l, n_dot_l) shadow_share(SHADOW_MAP_OF(i), light, l, n_dot_l)

#else
#define EACH_CASTER(one)
#endif
