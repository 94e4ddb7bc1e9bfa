// maps=specular.
GIVEN_MAP(u_specular_map)

P_SAMPLER vec3 specular_map(P_VARYING vec2 uv)
{
    P_SAMPLER vec3 texel = TEXTURE(u_specular_map, uv).rgb;
    PROBE_MAP(MAP_SPECULAR, texel)
    return texel;
}
