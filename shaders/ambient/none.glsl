// ambient=none: what no light reaches is black.
P_COLOR vec3 scene_ambient()
{
    return vec3(0.0);
}

void add_ambient(Incident light, inout Lit lit)
{
}
