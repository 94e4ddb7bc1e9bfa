// normalise=off: as interpolated.
P_VECTOR vec3 surface_normal(P_VECTOR vec3 interpolated)
{
    return interpolated;
}
