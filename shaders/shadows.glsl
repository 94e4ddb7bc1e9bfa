// Shadows of the first NR_SHADOWS point lights. One entry:
//     float caster_visibility(caster, PointLight light, vec3 to_light, float n_dot_l)
// the share of the taps that the light reaches, 0 to 1; to_light: world space, from the surface
// to the light. EACH_CASTER(one) is one(0) one(1) ... for all casters: each kind of map says
// whether the number of a caster must be a constant, as the index into an array of samplers
// must in GLSL 3.30 (4.1.7) and GLSL ES 3.00 (12.29).
#include "form.glsl"
#if NR_SHADOWS > 0
#include "shadow_store/$(SHADOW_STORE).glsl"
#include "shadow_map/$(SHADOW_MAP).glsl"
#include "shadow_filter/$(SHADOW_FILTER).glsl"
#include "shadow_bias_kind/$(SHADOW_BIAS_KIND).glsl"

P_ATTENUATION float shadow_share_naive(SHADOW_MAP_PARAMETERS, PointLight light,
                                       P_POSITION vec3 to_light, P_VECTOR float n_dot_l)
{
    P_ATTENUATION float range = light.range;
    P_POSITION float reference = shadow_reference(to_light, range, shadow_bias(n_dot_l));
    return shadow_filter(SHADOW_MAP_ARGUMENTS, -to_light, reference);
}

// What lies beyond the light's range is not lit. Without asking, the bias, a format that keeps
// negative distances, and the corners of a face, which are farther than its far plane, each
// have another end of the light. A select: lookups stand under no branch.
P_ATTENUATION float shadow_share_robust(SHADOW_MAP_PARAMETERS, PointLight light,
                                        P_POSITION vec3 to_light, P_VECTOR float n_dot_l)
{
    P_POSITION float range = light.range;
    P_ATTENUATION float share =
        shadow_share_naive(SHADOW_MAP_ARGUMENTS, light, to_light, n_dot_l);
    return length(to_light) < range ? share : 0.0;
}

#define caster_visibility(i, light, l, n_dot_l) shadow_share(SHADOW_MAP_OF(i), light, l, n_dot_l)

#else
#define EACH_CASTER(one)
#endif
