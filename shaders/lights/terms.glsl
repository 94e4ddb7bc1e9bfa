// What one light adds to the sums. An operation has the highest precision of its operands, so
// each step goes through a copy that has the precision of the next one.

void add_diffuse(Incident light, P_VECTOR float n_dot_l, inout Lit lit)
{
    P_COLOR float weight = light.factor * light.shown * n_dot_l;
    PROBE_TERM(TERM_DIFFUSE_WEIGHT, weight)
    P_SUM vec3 added = light.diffuse * weight;
    IF_DIFFUSE_MAP_EACH(added *= diffuse_map(v_uv);)
    lit.diffuse += added;
}

void add_specular(Surface surface, Incident light, inout Lit lit)
{
    P_SPECULAR float factor = specular_factor(surface, light.highlight);
    P_COLOR float weight = light.factor * light.shown * factor;
    PROBE_TERM(TERM_SPECULAR, factor)
    PROBE_TERM(TERM_SPECULAR_WEIGHT, weight)
    P_SUM vec3 added = light.specular * weight;
    WITH_FRESNEL(P_SPECULAR float c = FRESNEL_COSINE(surface, light.highlight);)
    IF_FRESNEL(added *= reflectance(u_material.specular, c);)
    IF_SPECULAR_MAP_EACH(added *= specular_map(v_uv);)
    lit.specular += added;
}

Lit no_light()
{
    return Lit(vec3(0.0), vec3(0.0), vec3(0.0));
}
