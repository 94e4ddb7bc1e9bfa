// Adds one light to the sums. An operation has the highest precision of its operands, so each
// step goes through a copy that has the precision of the next one.

void add_diffuse(Incident light, P_VECTOR float n_dot_l, inout Lit lit)
{
    P_COLOR float weight = light.factor * n_dot_l;
    P_SUM vec3 added = light.diffuse * weight;
    lit.diffuse += added;
}

void add_specular(Surface surface, Incident light, inout Lit lit)
{
    P_COLOR float weight = light.factor * specular_factor(surface, light.direction);
    P_SUM vec3 added = light.specular * weight;
    lit.specular += added;
}

void add_light(Surface surface, Incident light, inout Lit lit)
{
    IF_AMBIENT(add_ambient(light, lit);)
    P_VECTOR float n_dot_l = dot(surface.normal, light.direction);
    // A surface that faces away is not lit, and shows no highlight through itself. Cut by a
    // branch, not by a factor of 0: 0 * infinity is NaN.
    if (n_dot_l > 0.0) {
        IF_DIFFUSE(add_diffuse(light, n_dot_l, lit);)
        IF_SPECULAR(add_specular(surface, light, lit);)
    }
}
