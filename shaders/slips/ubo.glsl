// The slips of `ubo` (docs/sources.md).

// The reflected ray is compared with the normal, not with the view vector.
P_SPECULAR float slip_specular_factor(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 normal = normalize(surface.normal);
    P_SPECULAR float c = dot(normal, normalize(reflect(-to_light, normal)));
    return pow(max(c, 0.0), surface.shininess);
}

void slip_add_specular(Surface surface, Incident light, inout Lit lit)
{
    P_SPECULAR float factor = slip_specular_factor(surface, light.highlight);
    P_COLOR float weight = light.factor * light.shown * factor;
    PROBE_TERM(TERM_SPECULAR, factor)
    PROBE_TERM(TERM_SPECULAR_WEIGHT, weight)
    P_SUM vec3 added = light.specular * weight;
    IF_SPECULAR_MAP_EACH(added *= specular_map(v_uv);)
    lit.specular += added;
}
#define add_specular slip_add_specular

// Diffuse light takes the normal as it was interpolated: see surface_normal in
// shaders/stage/fragment.frag.
#define surface_normal(interpolated) (interpolated)

// The sum starts from a variable that nothing has set.
Lit slip_no_light()
{
    Lit lit;
    return lit;
}
#define no_light slip_no_light
