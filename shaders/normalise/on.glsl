// normalise=on: interpolation shortens a normal (by cos of half the angle between its ends), unless
// all vertices of a triangle have the same.
P_VECTOR vec3 surface_normal(P_VECTOR vec3 interpolated)
{
    P_VECTOR vec3 normal = interpolated;
    IF_RENORMALISE(normal = unit(normal);)
    return normal;
}
