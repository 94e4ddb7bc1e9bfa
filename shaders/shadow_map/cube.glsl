// shadow_map=cube: a cube map a light; the hardware picks the face (OpenGL 4.6 core, 8.13).
uniform SHADOW_CUBE u_shadow_map[NR_SHADOWS];

#define EACH_CASTER(one) UNROLLED_CASTER(one)
#define SHADOW_MAP_PARAMETERS SHADOW_CUBE map
#define SHADOW_MAP_ARGUMENTS map
#define SHADOW_MAP_OF(caster) u_shadow_map[caster]

P_ATTENUATION float shadow_tap(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                               P_POSITION float reference)
{
    return SHADOW_LIT_3(map, direction, reference);
}
