// cone=linear: 1 - (1 - cos a) / (1 - cos cut-off), the law of the LWJGL book.
//
// For narrow cones 1 - cos a cancels: with a cut-off of 0.1 degrees it has an error of 0.17 in
// highp, and with 10 degrees 0.15 in half precision. Lagrange's identity has the same value
// without the subtraction: sin^2 a = |l x axis|^2 for unit vectors, and
// 1 - cos a = sin^2 a / (1 + cos a). Behind the light (cones wider than 90 degrees) that
// quotient is the one that fails, and the plain form is exact.
P_ATTENUATION float cone_robust(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec3 axis = cone_axis(light);
    P_ATTENUATION float cos_a = dot(from_light, axis);
    P_ATTENUATION vec3 c = cross(from_light, axis);
    P_ATTENUATION float one_minus_cos =
        cos_a > 0.0 ? dot(c, c) / (1.0 + cos_a) : 1.0 - cos_a;
    P_ATTENUATION float inverse = CONE_INV_ONE_MINUS_COS(light);
    PROBE_RAW(TERM_CONE, one_minus_cos * inverse)
    return max(1.0 - one_minus_cos * inverse, 0.0);
}

P_ATTENUATION float cone_naive(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = dot(from_light, cone_axis(light));
    P_ATTENUATION float edge = CONE_COS_CUTOFF(light);
    PROBE_RAW(TERM_CONE, (1.0 - cos_a) / (1.0 - edge))
    return max(1.0 - (1.0 - cos_a) / (1.0 - edge), 0.0);
}
