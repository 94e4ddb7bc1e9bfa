// ambient=scene: one term for the whole scene.
uniform P_UNIFORM vec3 u_scene_ambient;

P_COLOR vec3 scene_ambient()
{
    return u_scene_ambient;
}

void add_ambient(Incident light, inout Lit lit)
{
}
