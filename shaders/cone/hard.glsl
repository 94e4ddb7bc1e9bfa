// cone=hard: full inside the cut-off angle, nothing outside. Cosines are compared, not angles:
// acos is NaN where rounding makes the cosine exceed 1.
P_ATTENUATION float cone_robust(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = dot(from_light, cone_axis(light));
    P_ATTENUATION float edge = CONE_COS_CUTOFF(light);
    return CUT(cos_a >= edge, 1.0);
}

P_ATTENUATION float cone_naive(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cut_off = light.cutoff;
    P_ATTENUATION float a = acos(dot(from_light, cone_axis(light)));
    PROBE_RAW(TERM_CONE, a)
    return CUT(a <= cut_off, 1.0);
}
