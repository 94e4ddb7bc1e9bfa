// Things with all maps, with a diffuse map only, and with none, on a ground without.
#include "scene/make.h"

static const struct sb_material material[] = {
    {{0.35f, 0.36f, 0.33f},
     {0.35f, 0.36f, 0.33f},
     {0.05f, 0.05f, 0.05f},
     8,
     1U << SB_MAP_DIFFUSE | 1U << SB_MAP_SPECULAR | 1U << SB_MAP_NORMAL},
    {{1, 1, 1}, {1, 1, 1}, {0.5f, 0.5f, 0.5f}, 32, 0},
    {{0.9f, 0.8f, 0.7f},
     {0.9f, 0.8f, 0.7f},
     {0.4f, 0.4f, 0.4f},
     24,
     1U << SB_MAP_SPECULAR | 1U << SB_MAP_NORMAL},
    {{0.2f, 0.3f, 0.65f},
     {0.2f, 0.3f, 0.65f},
     {0.5f, 0.5f, 0.5f},
     48,
     1U << SB_MAP_DIFFUSE | 1U << SB_MAP_SPECULAR | 1U << SB_MAP_NORMAL},
    {{0.6f, 0.55f, 0.4f},
     {0.6f, 0.55f, 0.4f},
     {0.2f, 0.2f, 0.2f},
     16,
     1U << SB_MAP_DIFFUSE | 1U << SB_MAP_SPECULAR | 1U << SB_MAP_NORMAL},
};

// x, z, size, turn, ball, material
static const struct sb_yard_object object[] = {
    {-3.6, -2.4, 1.4, 20, false, 1}, {-1.5, -3.2, 1, 0, true, 2},
    {1.2, -3, 1.2, 50, false, 3},    {3.5, -2.2, 1.3, 0, true, 4},
    {-2.6, 0.2, 1, 70, false, 1},    {-0.2, -0.6, 0.9, 0, true, 2},
    {2.3, 0.1, 1.1, 35, false, 3},   {4.3, 1.2, 0.8, 0, true, 4},
    {-4.2, 2.2, 0.8, 10, false, 1},  {-1.4, 2.6, 0.7, 0, true, 2},
    {1, 2.9, 0.8, 60, false, 3},     {3, 3.2, 0.6, 0, true, 4},
};

void sb_scene_partly_mapped(struct sb_scene *scene, const struct sb_variant *variant)
{
    struct sb_yard yard = sb_yard_common;
    yard.material = material;
    yard.material_count = sizeof material / sizeof *material;
    yard.object = object;
    yard.object_count = sizeof object / sizeof *object;
    sb_yard_make(scene, &yard, variant);
}
