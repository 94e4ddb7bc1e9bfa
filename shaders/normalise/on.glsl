// normalise=on: interpolation shortens a normal (by cos of half the angle between its ends).
P_VECTOR vec3 surface_normal(P_VECTOR vec3 interpolated)
{
    return unit(interpolated);
}
