// guard=branch: the sides of a surface.
void add_sides(Surface surface, Incident light, P_VECTOR float n_dot_l, inout Lit lit)
{
    if (n_dot_l > 0.0) {
        IF_DIFFUSE(add_diffuse(light, n_dot_l, lit);)
    }
    if (specular_reaches(n_dot_l)) {
        IF_SPECULAR(add_specular(surface, light, lit);)
    }
}
