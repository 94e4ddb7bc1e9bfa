// model=blinn: cosine between the half vector and the normal (Blinn 1977). Opposite light and
// view vectors have no half vector: unit() gives zero, and no highlight.
#include "highlight/$(NORMALISE).glsl"

// What is read of a light.
#define SPECULAR_OF(light) light.specular

// Of fresnel=schlick and of specular_norm=energy.
#define FRESNEL_COSINE(surface, to_light) dot(view_of(surface), unit(to_light + view_of(surface)))
#define HIGHLIGHT_NORM(n) ((n + 8.0) * 0.039788736) // (n + 8) / (8 pi)

P_SPECULAR float specular_factor_robust(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 half_vector = unit(to_light + view_of(surface));
    return cosine_power(surface.normal, half_vector, surface.shininess);
}

P_SPECULAR float specular_factor_naive(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 half_vector = unit(to_light + view_of(surface));
    P_SPECULAR float c = dot(surface.normal, half_vector);
    PROBE_RAW(TERM_SPECULAR, c)
    return NORM_TIMES(surface.shininess, pow(max(c, 0.0), surface.shininess));
}
