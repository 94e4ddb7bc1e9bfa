// Directional lights: parallel, not attenuated.
Incident dir_incident(DirLight light)
{
    P_VECTOR vec3 travels = light.direction;
    P_VECTOR vec3 direction = unit(-travels);
    PROBE_DIRECTION(direction)
    return Incident(direction, direction, 1.0, 1.0, AMBIENT_OF(light), light.diffuse,
                    SPECULAR_OF(light));
}
