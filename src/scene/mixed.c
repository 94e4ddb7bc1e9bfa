// Matte things, whose highlights are black, and glossy ones, half and half.
#include "scene/make.h"

static const struct sb_material material[] = {
    {{0.4f, 0.4f, 0.38f}, {0.4f, 0.4f, 0.38f}, {0, 0, 0}, 1, 0},
    {{0.65f, 0.3f, 0.2f}, {0.65f, 0.3f, 0.2f}, {0, 0, 0}, 1, 0},
    {{0.6f, 0.2f, 0.15f}, {0.6f, 0.2f, 0.15f}, {0.4f, 0.4f, 0.4f}, 32, 0},
    {{0.3f, 0.5f, 0.3f}, {0.3f, 0.5f, 0.3f}, {0, 0, 0}, 1, 0},
    {{0.2f, 0.3f, 0.65f}, {0.2f, 0.3f, 0.65f}, {0.5f, 0.5f, 0.5f}, 48, 0},
    {{0.6f, 0.55f, 0.4f}, {0.6f, 0.55f, 0.4f}, {0, 0, 0}, 1, 0},
    {{0.4f, 0.4f, 0.42f}, {0.4f, 0.4f, 0.42f}, {0.8f, 0.8f, 0.8f}, 96, 0},
};

// x, z, size, turn, ball, material
static const struct sb_yard_object object[] = {
    {-3.65, -3.36, 0.9, 0, false, 1}, {-1.15, -3.36, 1.1, 23, true, 2},
    {1.35, -3.36, 0.8, 46, false, 3}, {3.25, -3.36, 1, 69, false, 4},
    {-3.45, -1.26, 0.9, 2, true, 5},  {-0.95, -1.26, 1.1, 25, false, 6},
    {0.95, -1.26, 0.8, 48, false, 1}, {3.45, -1.26, 1, 71, true, 2},
    {-3.25, 0.84, 0.9, 4, false, 3},  {-1.35, 0.84, 1.1, 27, false, 4},
    {1.15, 0.84, 0.8, 50, true, 5},   {3.65, 0.84, 1, 73, false, 6},
    {-3.65, 2.94, 0.9, 6, false, 1},  {-1.15, 2.94, 1.1, 29, true, 2},
    {1.35, 2.94, 0.8, 52, false, 3},  {3.25, 2.94, 1, 75, false, 4},
};

void sb_scene_mixed(struct sb_scene *scene, const struct sb_variant *variant)
{
    struct sb_yard yard = sb_yard_common;
    yard.material = material;
    yard.material_count = sizeof material / sizeof *material;
    yard.object = object;
    yard.object_count = sizeof object / sizeof *object;
    yard.triangles = 1600;
    sb_yard_make(scene, &yard, variant);
}
