// A dark yard, seen by a flashlight whose cone touches a few things only.
#include "scene/make.h"

static const struct sb_vec3 eye = {0, 1.6, 8.5}, target = {-0.9, 0.4, 0};

// The flashlight first, held at the eye.
static struct sb_light_params spot_light(int i)
{
    struct sb_light_params light = sb_yard_spot(i);
    if (i == 0) {
        light = sb_light_torch(eye);
        light.direction = sb_vec3_sub(target, eye);
        light.inner = 7 * SB_DEGREE;
        light.outer = 9 * SB_DEGREE;
    }
    return light;
}

void sb_scene_flashlight(struct sb_scene *scene, const struct sb_variant *variant)
{
    struct sb_yard yard = sb_yard_common;
    yard.ambient = 0.05;
    yard.camera.eye = eye;
    yard.camera.target = (struct sb_vec3){0, 0.4, 0};
    yard.light[SB_LIGHT_SPOT] = spot_light;
    sb_yard_make(scene, &yard, variant);
}
