// attenuation=none: light reaches as far as it likes.
P_ATTENUATION float attenuation(PointLight light, P_ATTENUATION float d)
{
    return 1.0;
}
