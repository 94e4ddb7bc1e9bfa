// area_shape=capsule: a line segment with a radius. The nearest point of the segment is the
// centre of a ball (Karis 2013, "Real shading in Unreal Engine 4"). Vectors as in sphere.glsl.
#include "area_shape/segment.glsl"
#include "area_shape/ball.glsl"

P_POSITION vec3 area_nearest(AreaLight light, P_POSITION vec3 to_centre)
{
    P_POSITION vec3 half_axis = light.direction;
    P_POSITION float radius = light.radius;
    return ball_nearest(segment_nearest(to_centre, half_axis), radius);
}

P_POSITION vec3 area_nearest_ray(AreaLight light, P_POSITION vec3 to_centre,
                                 P_POSITION vec3 ray)
{
    P_POSITION vec3 half_axis = light.direction;
    P_POSITION float radius = light.radius;
    return ball_nearest_ray(segment_nearest_ray(to_centre, half_axis, ray), radius, ray);
}
