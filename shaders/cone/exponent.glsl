// cone=exponent: pow(cos a, exponent) inside the cut-off angle, nothing outside: the law of
// OpenGL's fixed function (OpenGL 2.1, 2.14.1).
//
// Robust: an exponent of 0 makes pow(0, 0), which is undefined, of a cut-off of 90 degrees and
// more; and a product of rounded unit vectors may exceed 1, which the power would multiply.
P_ATTENUATION float cone_robust(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = dot(from_light, cone_axis(light));
    P_ATTENUATION float edge = CONE_COS_CUTOFF(light);
    P_ATTENUATION float exponent = light.exponent;
    return CUT(cos_a >= edge, pow(clamp(cos_a, 1e-4, 1.0), exponent));
}

P_ATTENUATION float cone_naive(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = max(dot(from_light, cone_axis(light)), 0.0);
    P_ATTENUATION float edge = CONE_COS_CUTOFF(light);
    P_ATTENUATION float exponent = light.exponent;
    return CUT(cos_a >= edge, pow(cos_a, exponent));
}
