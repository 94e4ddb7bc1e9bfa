// shadow_map=cube_array: one cube map array, one cube a light.
uniform SHADOW_CUBE_ARRAY u_shadow_map;

#define EACH_CASTER(one) for (int caster = 0; caster < NR_SHADOWS; caster++) { one(caster) }
#define SHADOW_MAP_PARAMETERS int caster
#define SHADOW_MAP_ARGUMENTS caster
#define SHADOW_MAP_OF(caster) caster

P_ATTENUATION float shadow_tap(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                               P_POSITION float reference)
{
    return SHADOW_LIT_4(u_shadow_map, vec4(direction, float(caster)), reference);
}
