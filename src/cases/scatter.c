#include "cases/scatter.h"

#include "math/random.h"

static float between(struct sb_random *random, double low, double high)
{
    return (float)(low + (high - low) * sb_random_unit(random));
}

static void fill(struct sb_random *random, float *value, int count, double low,
                 double high)
{
    for (int i = 0; i < count; i++)
        value[i] = between(random, low, high);
}

static void scatter_point(struct sb_point *point, struct sb_random *random)
{
    fill(random, point->position, 3, -0.5, 0.5);
    fill(random, point->normal, 2, -0.5, 0.5);
    fill(random, point->eye, 2, -1, 1);
    point->eye[2] = between(random, 1, 3);
    fill(random, point->ambient, 3, 0, 0.2);
    fill(random, point->material.ambient, 3, 0, 1);
    fill(random, point->material.diffuse, 3, 0, 0.25);
    fill(random, point->material.specular, 3, 0, 0.25);
    point->material.shininess = between(random, 1, 64);
    for (int m = 0; m < SB_MAP_COUNT; m++)
        fill(random, point->texel[m], 3, 0.2, 0.8);
    point->texel[SB_MAP_NORMAL][2] = between(random, 0.8, 1);
}

static void scatter_light(struct sb_light *light, enum sb_light_type type,
                          struct sb_random *random)
{
    fill(random, light->position, 2, -0.5, 0.5);
    light->position[2] = between(random, 1, 2);
    if (type == SB_LIGHT_DIR)
        fill(random, light->direction, 2, -0.5, 0.5);
    fill(random, light->ambient, 3, 0, 0.1);
    fill(random, light->diffuse, 3, 0.1, 1);
    fill(random, light->specular, 3, 0.1, 1);
    light->constant = between(random, 0.5, 1);
    light->linear = between(random, 0, 1);
    light->quadratic = between(random, 0, 1);
    light->range = between(random, 3, 5);
    light->exponent = between(random, 1, 16);
    sb_light_set_cone(light, between(random, 0.1, 0.4), between(random, 0.5, 1.5));
}

void sb_points_scatter(struct sb_points *points, int count, uint64_t seed)
{
    struct sb_random random = sb_random_seed(seed);
    for (int p = 0; p < count; p++) {
        scatter_point(sb_points_add(points), &random);
        for (int i = 0; i < points->lights; i++)
            scatter_light(sb_points_light(points, points->count - 1, i), points->type[i],
                          &random);
    }
}
