// specular_side=both: highlights are not cut where the surface faces away from the light.
bool specular_reaches(P_VECTOR float n_dot_l)
{
    return true;
}
