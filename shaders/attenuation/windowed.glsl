// attenuation=windowed: the inverse square law, finite at the light and brought to 0 at its
// range (Karis 2013, "Real shading in Unreal Engine 4", equation 9).
//
// d^2 leaves the range of half floats at a distance of 256. 1 / infinity is the 0 that is right
// there; the quotient of d and the range stays below 1 where it matters.
//
// Robust: nothing is divided by a range of 0, which reaches nowhere.
P_ATTENUATION float attenuation_robust(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION float range = light.range;
    P_ATTENUATION float reached = d < range ? d / range : 1.0;
    PROBE_RAW(TERM_ATTENUATION, reached)
    P_ATTENUATION float q = min(reached, 1.0);
    P_ATTENUATION float window = 1.0 - q * q * q * q;
    return window * window / (d * d + 1.0);
}

P_ATTENUATION float attenuation_naive(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION float range = light.range;
    PROBE_RAW(TERM_ATTENUATION, d / range)
    P_ATTENUATION float q = min(d / range, 1.0);
    P_ATTENUATION float window = 1.0 - q * q * q * q;
    return window * window / (d * d + 1.0);
}
