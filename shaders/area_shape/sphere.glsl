// area_shape=sphere: a ball. Vectors from the surface: `to_centre` to the light's centre, `ray`
// of unit length along the reflected view vector.
#include "area_shape/ball.glsl"

P_POSITION vec3 area_nearest(AreaLight light, P_POSITION vec3 to_centre)
{
    P_POSITION float radius = light.radius;
    return ball_nearest(to_centre, radius);
}

P_POSITION vec3 area_nearest_ray(AreaLight light, P_POSITION vec3 to_centre,
                                 P_POSITION vec3 ray)
{
    P_POSITION float radius = light.radius;
    return ball_nearest_ray(to_centre, radius, ray);
}
