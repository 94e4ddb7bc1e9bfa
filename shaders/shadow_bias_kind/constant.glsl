// shadow_bias_kind=constant: the same for every surface.
P_ATTENUATION float shadow_bias(P_VECTOR float n_dot_l)
{
    return SHADOW_BIAS;
}
