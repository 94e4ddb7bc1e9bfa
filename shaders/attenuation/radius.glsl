// attenuation=radius: falls in a straight line to 0 at the light's range.
P_ATTENUATION float attenuation(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION float range = light.range;
    PROBE_RAW(TERM_ATTENUATION, 1.0 - d / range)
    return max(1.0 - d / range, 0.0);
}
