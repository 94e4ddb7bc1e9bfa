// ambient=per_light: each light adds its own, attenuated like its diffuse light, whichever way
// the surface faces.
P_COLOR vec3 scene_ambient()
{
    return vec3(0.0);
}

void add_ambient(Incident light, inout Lit lit)
{
    P_COLOR float weight = light.factor;
    P_SUM vec3 added = light.ambient * weight;
    lit.ambient += added;
}
