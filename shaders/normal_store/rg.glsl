// normal_store=rg: x and y are stored, and z follows from the unit length, as BC5 wants it.
//
// Filtering and compression may leave x and y too long, where the root is NaN.
P_SAMPLER vec3 restored_normal_robust(P_SAMPLER vec2 xy)
{
    return vec3(xy, sqrt(max(1.0 - dot(xy, xy), 0.0)));
}

P_SAMPLER vec3 restored_normal_naive(P_SAMPLER vec2 xy)
{
    return vec3(xy, sqrt(1.0 - xy.x * xy.x - xy.y * xy.y));
}

P_SAMPLER vec3 stored_normal(P_SAMPLER vec3 decoded)
{
    return restored_normal(decoded.xy);
}
