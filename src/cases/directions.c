#include "cases/directions.h"

#include <math.h>

struct sb_vec3 sb_any_direction(struct sb_random *random)
{
    const double z = 2 * sb_random_unit(random) - 1, r = sqrt(1 - z * z);
    const double turn = 2 * SB_PI * sb_random_unit(random);
    return (struct sb_vec3){r * cos(turn), r * sin(turn), z};
}

struct sb_vec3 sb_turned(struct sb_random *random, struct sb_vec3 from, double angle)
{
    struct sb_vec3 across = sb_vec3_cross(from, sb_any_direction(random));
    while (sb_vec3_length(across) < 0.1)
        across = sb_vec3_cross(from, sb_any_direction(random));
    return sb_vec3_normalise(
        sb_vec3_add(sb_vec3_scale(from, cos(angle)),
                    sb_vec3_scale(sb_vec3_normalise(across), sin(angle))));
}

struct sb_light *sb_points_in_cone(struct sb_points *points, struct sb_random *random,
                                   double angle, double inner, double outer)
{
    const struct sb_vec3 axis = sb_any_direction(random);
    const struct sb_vec3 from_light = sb_turned(random, axis, angle);
    struct sb_point *point = sb_points_add(points);
    struct sb_light *light = sb_points_light(points, points->count - 1, 0);
    const double way[3] = {from_light.x, from_light.y, from_light.z};
    const double along[3] = {axis.x, axis.y, axis.z};
    for (int c = 0; c < 3; c++) {
        light->position[c] = (float)(-2 * way[c]);
        light->direction[c] = (float)along[c];
        point->normal[c] = (float)-way[c];
    }
    sb_light_set_cone(light, inner, outer);
    return light;
}
