// maps=diffuse.
GIVEN_MAP(u_diffuse_map)

P_SAMPLER vec3 diffuse_map(P_VARYING vec2 uv)
{
    P_SAMPLER vec3 texel = TEXTURE(u_diffuse_map, uv).rgb;
    PROBE_MAP(MAP_DIFFUSE, texel)
    return texel;
}
