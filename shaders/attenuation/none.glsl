// attenuation=none: light reaches as far as it likes.
P_ATTENUATION float attenuation(P_ATTENUATION float d, P_ATTENUATION vec3 k)
{
    return 1.0;
}
