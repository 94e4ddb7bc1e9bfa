// cone=smooth: a ramp of the cosine between the outer and the inner angle. Scale and offset
// are made on the CPU, with a bounded divisor (Filament, LightManager::setSpotParams): the
// smoothstep of equal edges is undefined, this ramp is not.
P_ATTENUATION float cone(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec3 axis = light.direction;
    P_ATTENUATION float scale = light.cone_scale;
    P_ATTENUATION float offset = light.cone_offset;
    return clamp(dot(from_light, axis) * scale + offset, 0.0, 1.0);
}
