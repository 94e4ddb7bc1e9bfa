// shadow_bias_kind=slope: a texel of the map covers a depth that grows with the tangent of the
// angle between the normal and the light, and the bias with it, up to ten times. With
// sin = sqrt(1 - cos^2) the tangent is sin / cos; sin / 9 as the least divisor is what bounds
// it to 9, and lets no angle divide by 0.
P_ATTENUATION float shadow_bias(P_VECTOR float n_dot_l)
{
    P_ATTENUATION float c = clamp(n_dot_l, 0.0, 1.0);
    P_ATTENUATION float s = sqrt((1.0 - c) * (1.0 + c));
    return SHADOW_BIAS * (1.0 + s / max(c, s * (1.0 / 9.0)));
}
