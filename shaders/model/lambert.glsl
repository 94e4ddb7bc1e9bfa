// model=lambert: diffuse light only.
P_SPECULAR float specular_factor(Surface surface, P_VECTOR vec3 to_light)
{
    return 0.0;
}
