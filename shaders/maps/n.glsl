// maps=normal: normals of the surface's own frame, [-1, 1] stored in [0, 1].
GIVEN_MAP(u_normal_map)

P_SAMPLER vec3 normal_map(P_VARYING vec2 uv)
{
    P_SAMPLER vec3 texel = TEXTURE(u_normal_map, uv).rgb;
    PROBE_MAP(MAP_NORMAL, texel)
    return texel * 2.0 - 1.0;
}
