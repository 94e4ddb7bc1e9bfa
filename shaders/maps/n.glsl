// maps=normal: normals of the surface's own frame, [-1, 1] stored in [0, 1].
#include "form.glsl"
#include "normal_store/$(NORMAL_STORE).glsl"

GIVEN_MAP(u_normal_map)

// Eight bits have no middle: spread evenly, the flat texel 128 stands for 1/255, which tilts
// the normal by 0.32 degrees. So -1 is 1/255, 0 is 128/255 and 1 is 255/255, exactly.
P_SAMPLER vec3 decoded_normal_robust(P_SAMPLER vec3 texel)
{
    return (texel * 255.0 - 128.0) * (1.0 / 127.0);
}

P_SAMPLER vec3 decoded_normal_naive(P_SAMPLER vec3 texel)
{
    return texel * 2.0 - 1.0;
}

P_SAMPLER vec3 normal_map(P_VARYING vec2 uv)
{
    P_SAMPLER vec3 texel = TEXTURE(u_normal_map, uv).rgb;
    PROBE_MAP(MAP_NORMAL, texel)
    return stored_normal(decoded_normal(texel));
}
