// A field of tiles under 64 lamps of short reach: each tile and each thing is reached by a few.
#include "scene/make.h"

// x, z, size, turn, ball, material
static const struct sb_yard_object object[] = {
    {-4.4, -5.1, 0.5, 0, false, 1},  {-1.2, -5.1, 0.6, 31, true, 2},
    {2, -5.1, 0.7, 62, false, 3},    {5.2, -5.1, 0.5, 3, true, 4},
    {-4.4, -1.9, 0.6, 34, false, 1}, {-1.2, -1.9, 0.7, 65, true, 2},
    {2, -1.9, 0.5, 6, false, 3},     {5.2, -1.9, 0.6, 37, true, 4},
    {-4.4, 1.3, 0.7, 68, false, 1},  {-1.2, 1.3, 0.5, 9, true, 2},
    {2, 1.3, 0.6, 40, false, 3},     {5.2, 1.3, 0.7, 71, true, 4},
    {-4.4, 4.5, 0.5, 12, false, 1},  {-1.2, 4.5, 0.6, 43, true, 2},
    {2, 4.5, 0.7, 74, false, 3},     {5.2, 4.5, 0.5, 15, true, 4},
};

enum { LAMPS = 8 }; // in a row

// A lamp over the middle of each tile, then others between them.
static struct sb_light_params short_light(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    const double pitch = 12.8 / LAMPS;
    struct sb_light_params light = {
        .position = {(at.x - 0.5) * 11, 0.9, (at.z - 0.5) * 11},
        .range = 2.2,
        .constant = 1,
        .linear = 0.7,
        .quadratic = 1.8,
    };
    if (i < LAMPS * LAMPS) {
        light.position.x = (i % LAMPS - 0.5 * (LAMPS - 1)) * pitch;
        light.position.z = (i / LAMPS - 0.5 * (LAMPS - 1)) * pitch;
    }
    sb_light_colour(&light, i, 0.8);
    return light;
}

void sb_scene_lamps64(struct sb_scene *scene, const struct sb_variant *variant)
{
    struct sb_yard yard = sb_yard_common;
    yard.object = object;
    yard.object_count = sizeof object / sizeof *object;
    yard.side = 12.8;
    yard.tiles = 8;
    yard.triangles = 2400;
    yard.ambient = 0.05;
    yard.camera.eye = (struct sb_vec3){0, 11, 9};
    yard.camera.target = (struct sb_vec3){0, 0, 0.4};
    yard.camera.fov = 60 * SB_DEGREE;
    yard.light[SB_LIGHT_POINT] = short_light;
    sb_yard_make(scene, &yard, variant);
}
