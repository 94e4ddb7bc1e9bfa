// guard=mask: the sides of a surface.
void add_sides(Surface surface, Incident light, P_VECTOR float n_dot_l, inout Lit lit)
{
    IF_DIFFUSE(add_diffuse(light, max(n_dot_l, 0.0), lit);)
    IF_SPECULAR(light.specular *= specular_reaches(n_dot_l) ? 1.0 : 0.0;)
    IF_SPECULAR(add_specular(surface, light, lit);)
}
