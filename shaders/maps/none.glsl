// maps=none.
P_SAMPLER vec3 diffuse_map(P_VARYING vec2 uv)
{
    return vec3(1.0);
}

P_SAMPLER vec3 specular_map(P_VARYING vec2 uv)
{
    return vec3(1.0);
}
