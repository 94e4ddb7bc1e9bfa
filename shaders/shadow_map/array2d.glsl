// shadow_map=array2d: one 2D array texture, six layers a light.
uniform SHADOW_2D_ARRAY u_shadow_map;

#define EACH_CASTER(one) for (int caster = 0; caster < NR_SHADOWS; caster++) { one(caster) }
#define SHADOW_MAP_PARAMETERS int caster
#define SHADOW_MAP_ARGUMENTS caster
#define SHADOW_MAP_OF(caster) caster

#include "shadow_map/face.glsl"

P_ATTENUATION float shadow_tap(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                               P_POSITION float reference)
{
    P_POSITION vec3 at = shadow_face(direction);
    at.z += float(6 * caster);
    return SHADOW_LIT_3(u_shadow_map, at, reference);
}
