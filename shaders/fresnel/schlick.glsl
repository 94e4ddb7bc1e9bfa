// fresnel=schlick: the surface reflects its specular colour where it is seen head-on, and all
// light at a grazing angle (Schlick 1994, equation 15): F = F0 + (1 - F0) (1 - c)^5. The cosine
// c is the model's, and so other for each light.

// Each light's part of the sum has its own.
#define REFLECTED vec3(1.0)

// Rounding may make the cosine of unit vectors larger than 1. Products need no base that is
// positive, but a negative one would take light away.
P_SPECULAR float schlick_robust(P_SPECULAR float c)
{
    P_SPECULAR float x = max(1.0 - abs(c), 0.0);
    P_SPECULAR float x2 = x * x;
    return x2 * x2 * x;
}

// The power of a negative base is undefined (GLSL 4.60, 8.2).
P_SPECULAR float schlick_naive(P_SPECULAR float c)
{
    P_SPECULAR float power = pow(1.0 - abs(c), 5.0);
    PROBE_RAW(TERM_SPECULAR, power)
    return power;
}

P_COLOR vec3 reflectance(P_COLOR vec3 f0, P_SPECULAR float c)
{
    P_COLOR float grazing = schlick(c);
    return f0 + (1.0 - f0) * grazing;
}
