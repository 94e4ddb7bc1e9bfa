// cone=hard: full inside the cut-off angle, nothing outside. Cosines are compared, not angles:
// acos is NaN where rounding makes the cosine exceed 1.
P_ATTENUATION float cone(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec3 axis = light.direction;
    P_ATTENUATION float cut_off = light.cos_cutoff;
    return dot(from_light, axis) >= cut_off ? 1.0 : 0.0;
}
