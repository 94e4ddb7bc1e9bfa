// shadow_filter=1: the texel that the direction meets.
P_ATTENUATION float shadow_filter(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                                  P_POSITION float reference)
{
    return shadow_tap(SHADOW_MAP_ARGUMENTS, direction, reference);
}
