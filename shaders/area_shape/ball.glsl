// A ball of a radius around a point that `to_centre` leads to.

// Vector to its nearest point; from inside the ball to where one stands.
P_POSITION vec3 ball_nearest_robust(P_POSITION vec3 to_centre, P_POSITION float radius)
{
    P_POSITION float d = length(to_centre);
    return d > radius ? to_centre * ((d - radius) / d) : vec3(0.0);
}

// From inside it leads away from the centre, and at the centre it is 0 * infinity.
P_POSITION vec3 ball_nearest_naive(P_POSITION vec3 to_centre, P_POSITION float radius)
{
    P_POSITION float d = length(to_centre);
    return to_centre * ((d - radius) / d);
}

// Vector to the point of it that is nearest to the ray (Karis 2013, "Real shading in Unreal
// Engine 4", equation 11). A ray that meets the ball is not divided by how far it passes the
// centre, which may be 0.
P_POSITION vec3 ball_nearest_ray_robust(P_POSITION vec3 to_centre, P_POSITION float radius,
                                        P_POSITION vec3 ray)
{
    P_POSITION vec3 to_ray = dot(to_centre, ray) * ray - to_centre;
    P_POSITION float away = length(to_ray);
    return to_centre + (away > radius ? to_ray * (radius / away) : to_ray);
}

// The equation as printed: 0 / 0 for a ray through the centre of a ball of no radius, and
// 0 * infinity, which clamp() may hide, for one with a radius.
P_POSITION vec3 ball_nearest_ray_naive(P_POSITION vec3 to_centre, P_POSITION float radius,
                                       P_POSITION vec3 ray)
{
    P_POSITION vec3 to_ray = dot(to_centre, ray) * ray - to_centre;
    P_POSITION float scale = radius / length(to_ray);
    PROBE_RAW(TERM_DISTANCE, scale)
    return to_centre + to_ray * clamp(scale, 0.0, 1.0);
}
