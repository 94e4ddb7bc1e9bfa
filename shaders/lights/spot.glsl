// Spot lights: a point light that shines into a cone.
Incident spot_incident(SpotLight light, P_POSITION vec3 surface_position)
{
    Incident incident = point_incident(POINT_LIGHT_OF(light), surface_position);
    WITH_CONE(P_ATTENUATION float share = cone(light, -incident.direction);)
    IF_CONE(PROBE_TERM(TERM_CONE, share))
    IF_CONE(incident.factor *= share;)
    return incident;
}
