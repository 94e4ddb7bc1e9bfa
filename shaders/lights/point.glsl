// Point lights: from a position into all directions, attenuated.
#if NR_POINT_LIGHTS > 0

Incident point_incident(PointLight light, P_POSITION vec3 surface_position)
{
    P_POSITION vec3 light_position = light.position;
    P_POSITION vec3 to_light = light_position - surface_position;
    P_ATTENUATION vec3 k = vec3(light.constant, light.linear, light.quadratic);
    P_ATTENUATION float factor = 1.0;
    IF_ATTENUATION(factor = attenuation(length(to_light), k);)
    return Incident(unit_difference(to_light), factor, light.ambient, light.diffuse,
                    light.specular);
}

void add_point_lights(Surface surface, inout Lit lit)
{
    for (int i = 0; i < NR_POINT_LIGHTS; i++)
        add_light(surface, point_incident(u_point[i], surface.position), lit);
}

#else

void add_point_lights(Surface surface, inout Lit lit)
{
}

#endif
