// normalise=on: c^n for the cosine c of two unit vectors, 0 where they point apart.
//
// The cosine of a small angle has lost the angle: below 1 the numbers of half precision are
// 2^-11 apart, which is 1.8 degrees, and the power multiplies that error by n: 35 of 255 steps at
// n = 64. Lagrange's identity |a x b|^2 = |a|^2 |b|^2 - (a . b)^2 gives s, the square of
// the sine, with a relative error instead (as in D_GGX of Filament), and c^n = (1 - s)^(n/2)
// follows from the series of ln(1 - s), right to 2e-6 up to s = 1/8 for every n; beyond, the
// power takes so much off that the plain cosine does.
#include "log2_cosine.glsl"

P_SPECULAR float cosine_power(P_VECTOR vec3 a, P_VECTOR vec3 b, P_SPECULAR float n)
{
    P_VECTOR vec3 across = cross(a, b);
    P_SPECULAR float s = dot(across, across);
    P_SPECULAR float c = dot(a, b);
    PROBE_RAW(TERM_SPECULAR, c)
    P_SPECULAR float near = LOG2_COSINE(s);
    P_SPECULAR float log2_c = s < 0.125 ? near : log2(min(c, 1.0));
    return c > 0.0 ? NORM_EXP2(n * log2_c) : 0.0;
}
