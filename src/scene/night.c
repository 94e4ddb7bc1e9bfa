// A yard at night: the sun is down (axis `sun` above 90), and one lamp is on.
#include "scene/make.h"

// The lamp first, in the middle of the yard.
static struct sb_light_params point_light(int i)
{
    struct sb_light_params light = sb_yard_point(i);
    if (i == 0) {
        light.position = (struct sb_vec3){0.4, 2.4, 0.9};
        light.diffuse = light.specular = (struct sb_vec3){1.4, 1.1, 0.7};
    }
    return light;
}

void sb_scene_night(struct sb_scene *scene, const struct sb_variant *variant)
{
    struct sb_yard yard = sb_yard_common;
    yard.ambient = 0.05;
    yard.light[SB_LIGHT_POINT] = point_light;
    sb_yard_make(scene, &yard, variant);
}
