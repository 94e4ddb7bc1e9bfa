// model=lambert: diffuse light only.

// What is read of a light.
#define SPECULAR_OF(light) vec3(0.0)

P_SPECULAR float specular_factor(Surface surface, P_VECTOR vec3 to_light)
{
    return 0.0;
}
