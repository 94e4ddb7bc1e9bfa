// specular_side=front: a surface that faces away shows no highlight through itself.
bool specular_reaches(P_VECTOR float n_dot_l)
{
    IF_SPECULAR(PROBE_SIDE(n_dot_l > 0.0))
    return n_dot_l > 0.0;
}
