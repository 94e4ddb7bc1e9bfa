// Unit vectors. A zero vector stays zero, and so lights nothing: normalize(0) is 0 * infinity,
// a NaN. A select, not max(length, tiny): it is exact at every scale of the scene and needs no
// constant that would have to be a normal number in half precision too.

P_VECTOR vec3 unit(P_VECTOR vec3 v)
{
    P_VECTOR float v2 = dot(v, v);
    return v2 > 0.0 ? v * inversesqrt(v2) : v;
}

// From a difference of positions, whose square leaves the range of half floats at a distance
// of 256: squared in the precision of positions.
P_VECTOR vec3 unit_difference(P_POSITION vec3 d)
{
    P_POSITION float d2 = dot(d, d);
    return d2 > 0.0 ? d * inversesqrt(d2) : d;
}
