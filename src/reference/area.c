// Area lights by two points of theirs, after Karis 2013, "Real shading in Unreal Engine 4", and
// Picott 1992. Every shape is met by vectors from the surface.
#include "reference/parts.h"

// --- a ball ---------------------------------------------------------------------------------

// From inside it the nearest point is where one stands.
static struct sb_vec3 ball_nearest(struct sb_vec3 to_centre, double radius)
{
    const double d = sb_vec3_length(to_centre);
    return d > radius ? sb_vec3_scale(to_centre, (d - radius) / d)
                      : (struct sb_vec3){0, 0, 0};
}

// Equation 11. Where the ray meets the ball, the point of the ray that is nearest to the centre;
// else as far from there as the ball leaves free.
static struct sb_vec3 ball_nearest_ray(struct sb_vec3 to_centre, double radius,
                                       struct sb_vec3 ray)
{
    const struct sb_vec3 on_ray = sb_vec3_scale(ray, sb_vec3_dot(to_centre, ray));
    const struct sb_vec3 to_ray = sb_vec3_sub(on_ray, to_centre);
    const double away = sb_vec3_length(to_ray);
    return away > radius
               ? sb_vec3_sub(on_ray, sb_vec3_scale(to_ray, (away - radius) / away))
               : on_ray;
}

// --- a segment from centre - half_axis to centre + half_axis --------------------------------

// A segment of no length is its centre.
static struct sb_vec3 along(struct sb_vec3 to_centre, struct sb_vec3 half_axis,
                            double projection, double axis2)
{
    const double t = axis2 > 0 ? fmin(fmax(projection / axis2, -1), 1) : 0;
    return sb_vec3_add(to_centre, sb_vec3_scale(half_axis, t));
}

static struct sb_vec3 segment_nearest(struct sb_vec3 to_centre, struct sb_vec3 half_axis)
{
    return along(to_centre, half_axis, -sb_vec3_dot(to_centre, half_axis),
                 sb_vec3_dot(half_axis, half_axis));
}

// Of the segment's points less their part (point . ray) ray, the shortest. For a unit ray that
// part is cross(cross(ray, point), ray), and products of such are products of the
// crosses (Binet and Cauchy): nothing cancels where the segment is nearly along the ray. A ray
// whose square r is not 1, reflected by a normal that is none, leaves
// (c . ray)(a . ray)(1 - r)^2 / r of what lies along it.
static struct sb_vec3 segment_nearest_ray(struct sb_vec3 to_centre,
                                          struct sb_vec3 half_axis, struct sb_vec3 ray)
{
    const double r = sb_vec3_dot(ray, ray);
    if (!(r > 0)) // nothing is taken off
        return segment_nearest(to_centre, half_axis);
    const struct sb_vec3 centre_across = sb_vec3_cross(to_centre, ray);
    const struct sb_vec3 axis_across = sb_vec3_cross(half_axis, ray);
    const double centre_along = sb_vec3_dot(to_centre, ray);
    const double axis_along = sb_vec3_dot(half_axis, ray);
    const double left = (1 - r) * (1 - r);
    return along(
        to_centre, half_axis,
        -(sb_vec3_dot(centre_across, axis_across) + left * centre_along * axis_along),
        sb_vec3_dot(axis_across, axis_across) + left * axis_along * axis_along);
}

// --- a box along the axes of the world ------------------------------------------------------

static double to_interval(double centre, double half)
{
    return centre > half ? centre - half : centre < -half ? centre + half : 0;
}

static struct sb_vec3 box_nearest(struct sb_vec3 to_centre, struct sb_vec3 half)
{
    return (struct sb_vec3){to_interval(to_centre.x, half.x),
                            to_interval(to_centre.y, half.y),
                            to_interval(to_centre.z, half.z)};
}

static double into_interval(double at, double centre, double half)
{
    return at - centre > half ? centre + half : at - centre < -half ? centre - half : at;
}

// The ray is followed as far as the centre, and the box's point nearest to there taken
// (Drobot 2014, "Physically based area lights").
static struct sb_vec3 box_nearest_ray(struct sb_vec3 to_centre, struct sb_vec3 half,
                                      struct sb_vec3 ray)
{
    const struct sb_vec3 at = sb_vec3_scale(ray, fmax(sb_vec3_dot(to_centre, ray), 0));
    return (struct sb_vec3){into_interval(at.x, to_centre.x, half.x),
                            into_interval(at.y, to_centre.y, half.y),
                            into_interval(at.z, to_centre.z, half.z)};
}

// --- all of them ----------------------------------------------------------------------------

struct sb_vec3 sb_ref_area_nearest(int shape, const struct sb_light *light,
                                   struct sb_vec3 to_centre)
{
    const struct sb_vec3 half_axis = sb_ref_vec(light->direction);
    switch (shape) {
    case SB_AREA_TUBE:
        return segment_nearest(to_centre, half_axis);
    case SB_AREA_BOX:
        return box_nearest(to_centre, sb_ref_vec(light->extent));
    case SB_AREA_CAPSULE:
        return ball_nearest(segment_nearest(to_centre, half_axis), light->radius);
    default:
        return ball_nearest(to_centre, light->radius);
    }
}

struct sb_vec3 sb_ref_area_nearest_ray(int shape, const struct sb_light *light,
                                       struct sb_vec3 to_centre, struct sb_vec3 ray)
{
    const struct sb_vec3 half_axis = sb_ref_vec(light->direction);
    switch (shape) {
    case SB_AREA_TUBE:
        return segment_nearest_ray(to_centre, half_axis, ray);
    case SB_AREA_BOX:
        return box_nearest_ray(to_centre, sb_ref_vec(light->extent), ray);
    case SB_AREA_CAPSULE:
        return ball_nearest_ray(segment_nearest_ray(to_centre, half_axis, ray),
                                light->radius, ray);
    default:
        return ball_nearest_ray(to_centre, light->radius, ray);
    }
}
