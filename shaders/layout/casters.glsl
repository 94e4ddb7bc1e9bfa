// The first NR_SHADOWS point lights, which cast shadows.
#include "shadows.glsl"
#include "casters/$(CASTERS).glsl"

#if NR_SHADOWS > 0
Incident shaded(Incident light, P_ATTENUATION float shown)
{
    light.shown = shown;
    PROBE_SHOWN(shown)
    return light;
}

#define TO_CASTER(i) to_point_light(POINT_LIGHT(i), surface.position)
#define CASTER_N_DOT_L(i) dot(surface.normal, unit_difference(TO_CASTER(i)))
#define CASTER_SHOWN(i) caster_visibility(i, POINT_LIGHT(i), to_world(TO_CASTER(i)), CASTER_N_DOT_L(i))
#ifndef CASTER_LOOKUPS // by a slip
#define CASTER_LOOKUPS(i) CASTER_SHOWN(i)
#endif
#define ADD_CASTER(i) WHERE_LIT(i, add_light(surface, shaded(point_incident(POINT_LIGHT(i), surface.position), WHERE_SHADED(i, CASTER_LOOKUPS(i))), lit);)
void add_casters(Surface surface, inout Lit lit)
{
    EACH_CASTER(ADD_CASTER)
}
#else
void add_casters(Surface surface, inout Lit lit)
{
}
#endif
