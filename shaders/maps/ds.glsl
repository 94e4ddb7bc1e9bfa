// maps=diffuse+specular.
uniform SAMPLER2D u_diffuse_map;
uniform SAMPLER2D u_specular_map;

P_SAMPLER vec3 diffuse_map(P_VARYING vec2 uv)
{
    return TEXTURE(u_diffuse_map, uv).rgb;
}

P_SAMPLER vec3 specular_map(P_VARYING vec2 uv)
{
    return TEXTURE(u_specular_map, uv).rgb;
}
