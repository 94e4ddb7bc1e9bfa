// shadow_map=six2d: six 2D textures a light.
uniform SHADOW_2D u_shadow_map[6 * NR_SHADOWS];

#define EACH_CASTER(one) UNROLLED_CASTER(one)
#define SHADOW_XY_PARAMETERS SHADOW_2D xp, SHADOW_2D xn, SHADOW_2D yp, SHADOW_2D yn
#define SHADOW_MAP_PARAMETERS SHADOW_XY_PARAMETERS, SHADOW_2D zp, SHADOW_2D zn
#define SHADOW_MAP_ARGUMENTS xp, xn, yp, yn, zp, zn
#define SHADOW_MAPS_FROM(i) u_shadow_map[i], u_shadow_map[i + 1], u_shadow_map[i + 2]
#define SHADOW_MAP_OF(caster) SHADOW_MAPS_FROM(6 * caster), SHADOW_MAPS_FROM(6 * caster + 3)

#include "shadow_map/face.glsl"

P_ATTENUATION float shadow_tap(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                               P_POSITION float reference)
{
    P_POSITION vec3 at = shadow_face(direction);
    if (at.z < 0.5)
        return SHADOW_LIT_2(xp, at.xy, reference);
    if (at.z < 1.5)
        return SHADOW_LIT_2(xn, at.xy, reference);
    if (at.z < 2.5)
        return SHADOW_LIT_2(yp, at.xy, reference);
    if (at.z < 3.5)
        return SHADOW_LIT_2(yn, at.xy, reference);
    if (at.z < 4.5)
        return SHADOW_LIT_2(zp, at.xy, reference);
    return SHADOW_LIT_2(zn, at.xy, reference);
}
