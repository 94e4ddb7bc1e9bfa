// ambient=scene: one term for the whole scene.
GIVEN_UNIFORM P_UNIFORM vec3 u_scene_ambient;

// What is read of a light.
#define AMBIENT_OF(light) vec3(0.0)

P_COLOR vec3 scene_ambient()
{
    P_COLOR vec3 ambient = u_scene_ambient;
    IF_DIFFUSE_MAP_EACH(ambient *= diffuse_map(v_uv);)
    return ambient;
}

void add_ambient(Incident light, inout Lit lit)
{
}
