// Spot lights: a point light that shines into a cone.
#if NR_SPOT_LIGHTS > 0

Incident spot_incident(SpotLight light, P_POSITION vec3 surface_position)
{
    P_POSITION vec3 light_position = light.position;
    P_POSITION vec3 to_light = light_position - surface_position;
    P_VECTOR vec3 direction = unit_difference(to_light);
    P_ATTENUATION vec3 k = vec3(light.constant, light.linear, light.quadratic);
    P_ATTENUATION float factor = 1.0;
    IF_ATTENUATION(factor = attenuation(length(to_light), k);)
    IF_CONE(factor *= cone(light, -direction);)
    return Incident(direction, factor, light.ambient, light.diffuse, light.specular);
}

void add_spot_lights(Surface surface, inout Lit lit)
{
    for (int i = 0; i < NR_SPOT_LIGHTS; i++)
        add_light(surface, spot_incident(u_spot[i], surface.position), lit);
}

#else

void add_spot_lights(Surface surface, inout Lit lit)
{
}

#endif
