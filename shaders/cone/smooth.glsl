// cone=smooth: a ramp of the cosine between the outer and the inner angle.
//
// Robust: scale and offset have a bounded divisor (Filament, LightManager::setSpotParams).
P_ATTENUATION float cone_robust(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec2 ramp = CONE_RAMP(light);
    PROBE_RAW(TERM_CONE, dot(from_light, cone_axis(light)) * ramp.x + ramp.y)
    return clamp(dot(from_light, cone_axis(light)) * ramp.x + ramp.y, 0.0, 1.0);
}

// The smoothstep of equal edges is undefined (GLSL 4.60, 8.3). It eases the ramp at both ends:
// another law, with the same edges.
P_ATTENUATION float cone_naive(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = dot(from_light, cone_axis(light));
    P_ATTENUATION vec2 edges = CONE_EDGES(light);
    PROBE_RAW(TERM_CONE, (cos_a - edges.x) / (edges.y - edges.x))
    return smoothstep(edges.x, edges.y, cos_a);
}
