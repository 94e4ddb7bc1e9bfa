// maps=diffuse.
uniform SAMPLER2D u_diffuse_map;

P_SAMPLER vec3 diffuse_map(P_VARYING vec2 uv)
{
    return TEXTURE(u_diffuse_map, uv).rgb;
}
