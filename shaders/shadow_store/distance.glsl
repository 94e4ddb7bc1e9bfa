// Stored: the distance to the light as 1 - d/range, which is 1 at the light, 0 where its range
// ends and, in formats that keep it, negative beyond.
#define SHADOW_2D SAMPLER(P_ATTENUATION, sampler2D)
#define SHADOW_2D_ARRAY SAMPLER(P_ATTENUATION, sampler2DArray)
#define SHADOW_CUBE SAMPLER(P_ATTENUATION, samplerCube)
#define SHADOW_CUBE_ARRAY SAMPLER(P_ATTENUATION, samplerCubeArray)

// 1 where the light reaches, else 0: by two, three and four coordinates.
#define SHADOW_LIT_2(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)
#define SHADOW_LIT_3(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)
#define SHADOW_LIT_4(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)

P_ATTENUATION float shadow_stored(P_POSITION vec3 to_light, P_ATTENUATION float range)
{
    P_ATTENUATION float d = length(to_light);
    return 1.0 - d / range;
}

P_POSITION float shadow_reference(P_POSITION vec3 to_light, P_ATTENUATION float range,
                                  P_ATTENUATION float bias)
{
    return shadow_stored(to_light, range) + bias;
}

// In the program that draws the map.
#define DECLARE_O_STORED out P_ATTENUATION float o_stored;
#define STORE(to_light, range) o_stored = shadow_stored(to_light, range);
