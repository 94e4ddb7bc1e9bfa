// normal_store=rgb: all three components are stored.
P_SAMPLER vec3 stored_normal(P_SAMPLER vec3 decoded)
{
    return decoded;
}
