// A ball of a radius around a point that `to_centre` leads to.

// Vector to its nearest point; from inside the ball to where one stands.
P_POSITION vec3 ball_nearest(P_POSITION vec3 to_centre, P_POSITION float radius)
{
    P_POSITION float d = length(to_centre);
    return d > radius ? to_centre * ((d - radius) / d) : vec3(0.0);
}

// Vector to the point of it that is nearest to the ray (Karis 2013, "Real shading in Unreal
// Engine 4", equation 11).
P_POSITION vec3 ball_nearest_ray(P_POSITION vec3 to_centre, P_POSITION float radius,
                                 P_POSITION vec3 ray)
{
    P_POSITION vec3 to_ray = dot(to_centre, ray) * ray - to_centre;
    P_POSITION float away = length(to_ray);
    return to_centre + (away > radius ? to_ray * (radius / away) : to_ray);
}
