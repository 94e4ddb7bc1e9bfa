// model=blinn: cosine between the half vector and the normal (Blinn 1977).
#include "highlight/$(NORMALISE).glsl"

// Opposite light and view vectors have no half vector, and nearly opposite ones have lost it: what
// is left of their sum is the rounding of its parts, 1e-7 in highp and 1e-3 in half precision, so at a
// length of 0.01 its direction is off by 1e-5 or 0.1. Below that (0.6 degrees) there is no highlight.
P_VECTOR vec3 half_vector_robust(P_VECTOR vec3 to_light, P_VECTOR vec3 view)
{
    P_VECTOR vec3 h = to_light + view;
    P_VECTOR float h2 = dot(h, h);
    return h2 > 1e-4 ? h * inversesqrt(h2) : vec3(0.0);
}

P_VECTOR vec3 half_vector_naive(P_VECTOR vec3 to_light, P_VECTOR vec3 view)
{
    return unit(to_light + view);
}

// What is read of a light.
#define SPECULAR_OF(light) light.specular

// Of fresnel=schlick and of specular_norm=energy.
#define FRESNEL_COSINE(surface, to_light) dot(view_of(surface), half_vector(to_light, view_of(surface)))
#define HIGHLIGHT_NORM(n) ((n + 8.0) * 0.039788736) // (n + 8) / (8 pi)

P_SPECULAR float specular_factor_robust(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 h = half_vector(to_light, view_of(surface));
    return cosine_power(surface.normal, h, surface.shininess);
}

P_SPECULAR float specular_factor_naive(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 h = half_vector(to_light, view_of(surface));
    P_SPECULAR float c = dot(surface.normal, h);
    PROBE_RAW(TERM_SPECULAR, c)
    return NORM_TIMES(surface.shininess, pow(max(c, 0.0), surface.shininess));
}
