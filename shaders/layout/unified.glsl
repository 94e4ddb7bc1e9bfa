// layout=unified: one loop over lights that are told apart at run time, by w (0: directional)
// and by the cut-off angle (half a turn: no cone).
Incident incident_of(Light light, P_POSITION vec3 surface_position)
{
    if (light.w == 0.0) {
        light.direction = -light.position;
        return dir_incident(DIR_LIGHT_OF(light));
    }
    if (light.cos_cutoff > -1.0)
        return spot_incident(SPOT_LIGHT_OF(light), surface_position);
    return point_incident(POINT_LIGHT_OF(light), surface_position);
}

#if MAX_LIGHTS > 0
#define ADD_LIGHT(i) add_light(surface, incident_of(LIGHT(i), surface.position), lit);
void add_lights(Surface surface, inout Lit lit)
{
    EACH_LIGHT(ADD_LIGHT)
}
#else
void add_lights(Surface surface, inout Lit lit)
{
}
#endif
