// attenuation=radius: falls in a straight line to 0 at the light's range.
//
// Robust: nothing is divided by a range of 0, which reaches nowhere. The bound remains for
// quotients that a driver rounds up to more than 1.
P_ATTENUATION float attenuation_robust(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION float range = light.range;
    P_ATTENUATION float left = d < range ? 1.0 - d / range : 0.0;
    PROBE_RAW(TERM_ATTENUATION, left)
    return max(left, 0.0);
}

P_ATTENUATION float attenuation_naive(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION float range = light.range;
    PROBE_RAW(TERM_ATTENUATION, 1.0 - d / range)
    return max(1.0 - d / range, 0.0);
}
