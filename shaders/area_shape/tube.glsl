// area_shape=tube: a line segment, as a fluorescent lamp. Vectors as in sphere.glsl.
#include "area_shape/segment.glsl"

P_POSITION vec3 area_nearest(AreaLight light, P_POSITION vec3 to_centre)
{
    P_POSITION vec3 half_axis = light.direction;
    return segment_nearest(to_centre, half_axis);
}

P_POSITION vec3 area_nearest_ray(AreaLight light, P_POSITION vec3 to_centre,
                                 P_POSITION vec3 ray)
{
    P_POSITION vec3 half_axis = light.direction;
    return segment_nearest_ray(to_centre, half_axis, ray);
}
