// Unit vectors. Of a difference of positions: its square leaves the range of half floats at a
// distance of 256, so it is squared in the precision of positions.
#include "form.glsl"

// A zero vector stays zero, and so lights nothing: normalize(0) is 0 * infinity, a NaN. A
// select, not max(length, tiny): it is exact at every scale of the scene and needs no constant
// that would have to be a normal number in half precision too.
P_VECTOR vec3 unit_robust(P_VECTOR vec3 v)
{
    P_VECTOR float v2 = dot(v, v);
    return v2 > 0.0 ? v * inversesqrt(v2) : v;
}

P_VECTOR vec3 unit_difference_robust(P_POSITION vec3 d)
{
    P_POSITION float d2 = dot(d, d);
    return d2 > 0.0 ? d * inversesqrt(d2) : d;
}

P_VECTOR vec3 unit_naive(P_VECTOR vec3 v)
{
    return normalize(v);
}

P_VECTOR vec3 unit_difference_naive(P_POSITION vec3 d)
{
    return normalize(d);
}
