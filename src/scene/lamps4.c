// Four lamps over a few things.
#include "scene/make.h"

// The four lamps first, at the corners of a square.
static struct sb_light_params point_light(int i)
{
    struct sb_light_params light = sb_yard_point(i);
    if (i < 4)
        light.position = (struct sb_vec3){i % 2 ? 2.8 : -2.8, 2.2, i < 2 ? -2 : 2};
    return light;
}

void sb_scene_lamps4(struct sb_scene *scene, const struct sb_variant *variant)
{
    struct sb_yard yard = sb_yard_common;
    yard.light[SB_LIGHT_POINT] = point_light;
    sb_yard_make(scene, &yard, variant);
}
