// A lamp in a corner of the yard casts shadows (shadows=1); its light ends before most of the
// ground, whose tiles and things need no shadow map.
#include "scene/make.h"

static const struct sb_material material[] = {
    {{0.35f, 0.36f, 0.33f}, {0.35f, 0.36f, 0.33f}, {0.05f, 0.05f, 0.05f}, 8, 0},
    {{0.6f, 0.2f, 0.15f}, {0.6f, 0.2f, 0.15f}, {0.4f, 0.4f, 0.4f}, 32, 0},
    {{0.2f, 0.3f, 0.65f}, {0.2f, 0.3f, 0.65f}, {0.5f, 0.5f, 0.5f}, 48, 0},
    {{0.7f, 0.6f, 0.4f}, {0.7f, 0.6f, 0.4f}, {0.2f, 0.2f, 0.2f}, 16, 0},
    {{0.4f, 0.4f, 0.42f}, {0.4f, 0.4f, 0.42f}, {0.8f, 0.8f, 0.8f}, 96, 0},
};

// x, z, size, turn, ball, material
static const struct sb_yard_object object[] = {
    {-3.6, -2.4, 1.4, 20, false, 1}, {-1.5, -3.2, 1, 0, true, 2},
    {1.2, -3, 1.2, 50, false, 3},    {3.5, -2.2, 1.3, 0, true, 4},
    {-2.6, 0.2, 1, 70, false, 2},    {-0.2, -0.6, 0.9, 0, true, 1},
    {2.3, 0.1, 1.1, 35, false, 4},   {4.3, 1.2, 0.8, 0, true, 3},
    {-4.2, 2.2, 0.8, 10, false, 3},  {-1.4, 2.6, 0.7, 0, true, 4},
    {1, 2.9, 0.8, 60, false, 1},     {3, 3.2, 0.6, 0, true, 2},
};

// The lamp first; the others shine everywhere.
static struct sb_light_params point_light(int i)
{
    struct sb_light_params light = sb_yard_point(i);
    if (i == 0) {
        light.position = (struct sb_vec3){-2.9, 1.5, 3.2};
        light.range = 3.4;
        light.diffuse = light.specular = (struct sb_vec3){1.4, 1.2, 0.9};
    }
    return light;
}

void sb_scene_one_caster(struct sb_scene *scene, const struct sb_variant *variant)
{
    static const struct sb_yard yard = {
        .side = 12,
        .tiles = 6,
        .object = object,
        .object_count = sizeof object / sizeof *object,
        .material = material,
        .material_count = sizeof material / sizeof *material,
        .triangles = 1600,
        .ambient = 0.1,
        .camera = SB_YARD_CAMERA,
        .light = {sb_yard_dir, point_light, sb_yard_spot, sb_yard_area},
    };
    sb_yard_make(scene, &yard, variant);
}
