// Point lights: from a position into all directions, attenuated.
P_POSITION vec3 to_point_light(PointLight light, P_POSITION vec3 surface_position)
{
    P_POSITION vec3 light_position = light.position;
    return light_position - surface_position;
}

Incident point_incident(PointLight light, P_POSITION vec3 surface_position)
{
    P_POSITION vec3 to_light = to_point_light(light, surface_position);
    P_VECTOR vec3 direction = unit_difference(to_light);
    PROBE_TERM(TERM_DISTANCE, length(to_light))
    PROBE_DIRECTION(direction)
    P_ATTENUATION float factor = 1.0;
    IF_ATTENUATION(factor = attenuation(light, length(to_light));)
    PROBE_TERM(TERM_ATTENUATION, factor)
    return Incident(direction, direction, factor, 1.0, AMBIENT_OF(light), light.diffuse,
                    SPECULAR_OF(light));
}
