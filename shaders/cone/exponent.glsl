// cone=exponent: pow(cos a, exponent) inside the cut-off angle, nothing outside: the law of
// OpenGL's fixed function (OpenGL 2.1, 2.14.1).
//
// Robust: an exponent of 0 makes pow(0, 0), which is undefined, of a cut-off of 90 degrees and
// more. And the power multiplies the error of its base, so near the axis it is that of the sine,
// as of highlights (highlight/on.glsl). Elsewhere the error of the lengths is taken off again:
// by Lagrange's identity s + cos^2 a is |l|^2 |axis|^2, and log2(1 + x) / 2 is near 0.72134752 x.
#include "log2_cosine.glsl"

P_ATTENUATION float cone_robust(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec3 axis = cone_axis(light);
    P_ATTENUATION float cos_a = dot(from_light, axis);
    P_ATTENUATION vec3 c = cross(from_light, axis);
    P_ATTENUATION float s = dot(c, c);
    P_ATTENUATION float near = LOG2_COSINE(s);
    P_ATTENUATION float too_long = s + cos_a * cos_a - 1.0;
    P_ATTENUATION float far = log2(clamp(cos_a, 1e-4, 1.0)) - 0.72134752 * too_long;
    P_ATTENUATION float log2_c = cos_a > 0.0 && s < 0.125 ? near : far;
    P_ATTENUATION float edge = CONE_COS_CUTOFF(light);
    P_ATTENUATION float exponent = light.exponent;
    return CUT(cos_a >= edge, exp2(exponent * log2_c));
}

P_ATTENUATION float cone_naive(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = max(dot(from_light, cone_axis(light)), 0.0);
    P_ATTENUATION float edge = CONE_COS_CUTOFF(light);
    P_ATTENUATION float exponent = light.exponent;
    return CUT(cos_a >= edge, pow(cos_a, exponent));
}
