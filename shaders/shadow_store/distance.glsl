// Stored: the distance to the light as 1 - d/range, which is 1 at the light and 0 where its range
// ends.
#include "form.glsl"

#define SHADOW_2D SAMPLER(P_ATTENUATION, sampler2D)
#define SHADOW_2D_ARRAY SAMPLER(P_ATTENUATION, sampler2DArray)
#define SHADOW_CUBE SAMPLER(P_ATTENUATION, samplerCube)
#define SHADOW_CUBE_ARRAY SAMPLER(P_ATTENUATION, samplerCubeArray)

// 1 where the light reaches, else 0: by two, three and four coordinates.
#define SHADOW_LIT_2(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)
#define SHADOW_LIT_3(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)
#define SHADOW_LIT_4(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)

// Beyond the range the same in every format: 0.
P_ATTENUATION float shadow_stored_robust(P_ATTENUATION float d, P_ATTENUATION float range)
{
    return max(1.0 - d / range, 0.0);
}

// In formats that keep it, negative beyond the range.
P_ATTENUATION float shadow_stored_naive(P_ATTENUATION float d, P_ATTENUATION float range)
{
    return 1.0 - d / range;
}

P_POSITION float shadow_reference(P_POSITION vec3 to_light, P_ATTENUATION float range,
                                  P_ATTENUATION float bias)
{
    P_ATTENUATION float d = length(to_light);
    return 1.0 - d / range + bias;
}

// In the program that draws the map.
#define DECLARE_O_STORED out P_ATTENUATION float o_stored;
#define STORE(d, range) o_stored = shadow_stored(d, range);
