// A resolved variant with the axes that scenes read, and a scene made from it.
#pragma once

#include "test.h"

#include "scene/scene.h"

static inline struct sb_variant scene_variant(int dirs, int points, int spots)
{
    struct sb_variant v = {0};
    v.value[SB_AXIS_DIR] = dirs;
    v.value[SB_AXIS_POINT] = points;
    v.value[SB_AXIS_SPOT] = spots;
    v.value[SB_AXIS_TESSELLATION] = 2000;
    v.value[SB_AXIS_WIDTH] = 256;
    v.value[SB_AXIS_HEIGHT] = 256;
    v.value[SB_AXIS_SCALE] = 1;
    v.value[SB_AXIS_SUN] = -91; // the scene's own
    return v;
}

// Light number i of a type.
static inline const struct sb_light *light_of(const struct sb_scene *scene,
                                              enum sb_light_type type, int i)
{
    int count;
    return sb_lights_of(&scene->lights, type, &count) + i;
}

static inline struct sb_scene made(const char *name, const struct sb_variant *variant)
{
    struct sb_scene scene = {0};
    struct sb_error err = {0};
    if (!sb_scene_make(name, variant, &scene, &err)) {
        print_error("%s\n", err.text);
        fail();
    }
    return scene;
}
