// specular_side=front: a surface that faces away shows no highlight through itself.
bool specular_reaches(P_VECTOR float n_dot_l)
{
    return n_dot_l > 0.0;
}
