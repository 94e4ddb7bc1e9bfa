// area_shape=box: a box along the axes of the world. Vectors as in sphere.glsl.

// The ray is followed as far as the box's centre, and the box's point nearest to there taken:
// a representative point (Picott 1992; Drobot 2014, "Physically based area lights").
P_POSITION vec3 area_nearest_ray(AreaLight light, P_POSITION vec3 to_centre,
                                 P_POSITION vec3 ray)
{
    P_POSITION vec3 extent = light.extent;
    P_POSITION vec3 on_ray = max(dot(to_centre, ray), 0.0) * ray;
    P_POSITION vec3 from_centre = to_world(on_ray - to_centre);
    return to_centre + from_world(clamp(from_centre, -extent, extent));
}

P_POSITION vec3 area_nearest(AreaLight light, P_POSITION vec3 to_centre)
{
    P_POSITION vec3 extent = light.extent;
    return to_centre + from_world(clamp(to_world(-to_centre), -extent, extent));
}
