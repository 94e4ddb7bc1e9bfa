// ambient=per_light: each light adds its own, attenuated like its diffuse light, whichever way
// the surface faces and whatever shadow it lies in.

// What is read of a light.
#define AMBIENT_OF(light) light.ambient

P_COLOR vec3 scene_ambient()
{
    return vec3(0.0);
}

void add_ambient(Incident light, inout Lit lit)
{
    P_COLOR float weight = light.factor;
    P_SUM vec3 added = light.ambient * weight;
    IF_DIFFUSE_MAP_EACH(added *= diffuse_map(v_uv);)
    lit.ambient += added;
}
