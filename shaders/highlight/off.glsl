// normalise=off: c^n for c = a . b, where a has the length that interpolation has left it: no
// identity of unit vectors helps, and 1 is an upper bound only.
//
// The lower bound keeps pow() in its domain: a base below 0 is undefined. n is never 0: so is
// pow(0, 0).
P_SPECULAR float cosine_power(P_VECTOR vec3 a, P_VECTOR vec3 b, P_SPECULAR float n)
{
    P_SPECULAR float c = dot(a, b);
    PROBE_RAW(TERM_SPECULAR, c)
    return NORM_POW(clamp(c, 0.0, 1.0), n);
}
