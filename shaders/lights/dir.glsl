// Directional lights: parallel, not attenuated.
#if NR_DIR_LIGHTS > 0

Incident dir_incident(DirLight light)
{
    P_VECTOR vec3 travels = light.direction;
    return Incident(unit(-travels), 1.0, light.ambient, light.diffuse, light.specular);
}

void add_dir_lights(Surface surface, inout Lit lit)
{
    for (int i = 0; i < NR_DIR_LIGHTS; i++)
        add_light(surface, dir_incident(u_dir[i]), lit);
}

#else

void add_dir_lights(Surface surface, inout Lit lit)
{
}

#endif
