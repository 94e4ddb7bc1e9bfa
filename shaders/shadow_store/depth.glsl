// shadow_store=depth: the depth buffer itself, with a comparing sampler.
#define SHADOW_2D SAMPLER(P_ATTENUATION, sampler2DShadow)
#define SHADOW_2D_ARRAY SAMPLER(P_ATTENUATION, sampler2DArrayShadow)
#define SHADOW_CUBE SAMPLER(P_ATTENUATION, samplerCubeShadow)
#define SHADOW_CUBE_ARRAY SAMPLER(P_ATTENUATION, samplerCubeArrayShadow)

// 1 where the light reaches, else 0: by two, three and four coordinates.
#define SHADOW_LIT_2(map, at, reference) texture(map, vec3(at, reference))
#define SHADOW_LIT_3(map, at, reference) texture(map, vec4(at, reference))
#define SHADOW_LIT_4(map, at, reference) texture(map, at, reference)

// The depth of the point moved to the light by the bias, so that the bias means what it means
// for a stored distance. Depth counts along the axis of the face, which is that of the largest
// component m; the planes of the projection lie at range/1000 and range, and so
// depth = (1 - near/m) / (1 - near/far) = 1 - (range/m - 1) / 999.
P_POSITION float shadow_reference(P_POSITION vec3 to_light, P_ATTENUATION float range,
                                  P_ATTENUATION float bias)
{
    P_POSITION vec3 a = abs(to_light);
    P_POSITION float near = range * 0.001;
    P_POSITION float d = max(length(to_light), near); // a point on the light is lit, not NaN
    P_POSITION float m = max(a.x, max(a.y, a.z)) * (1.0 - bias * range / d);
    return 1.0 - (range / max(m, near) - 1.0) / 999.0;
}

// In the program that draws the map: the rasteriser stores.
#define DECLARE_O_STORED
#define STORE(d, range)
