// cone=smooth: a ramp of the cosine between the outer and the inner angle. Scale and offset
// have a bounded divisor (Filament, LightManager::setSpotParams): the smoothstep of equal edges
// is undefined, this ramp is not.
P_ATTENUATION float cone(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec2 ramp = CONE_RAMP(light);
    PROBE_RAW(TERM_CONE, dot(from_light, cone_axis(light)) * ramp.x + ramp.y)
    return clamp(dot(from_light, cone_axis(light)) * ramp.x + ramp.y, 0.0, 1.0);
}
