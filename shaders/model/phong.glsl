// model=phong: cosine between the reflected ray and the view vector (Phong 1975).
#include "highlight/$(NORMALISE).glsl"

// What is read of a light.
#define SPECULAR_OF(light) light.specular

// Of fresnel=schlick and of specular_norm=energy.
#define FRESNEL_COSINE(surface, to_light) dot(view_of(surface), surface.normal)
#define HIGHLIGHT_NORM(n) ((n + 2.0) * 0.15915494) // (n + 2) / (2 pi)

P_SPECULAR float specular_factor_robust(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 reflected = reflect(-to_light, surface.normal);
    return cosine_power(reflected, view_of(surface), surface.shininess);
}

P_SPECULAR float specular_factor_naive(Surface surface, P_VECTOR vec3 to_light)
{
    P_SPECULAR float c = dot(reflect(-to_light, surface.normal), view_of(surface));
    PROBE_RAW(TERM_SPECULAR, c)
    return NORM_TIMES(surface.shininess, pow(max(c, 0.0), surface.shininess));
}
