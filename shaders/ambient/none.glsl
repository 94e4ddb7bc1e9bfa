// ambient=none: what no light reaches is black.

// What is read of a light.
#define AMBIENT_OF(light) vec3(0.0)

P_COLOR vec3 scene_ambient()
{
    return vec3(0.0);
}

void add_ambient(Incident light, inout Lit lit)
{
}
