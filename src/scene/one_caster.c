// A lamp in a corner of the yard casts shadows (shadows=1); its light ends before most of the
// ground, whose tiles and things need no shadow map.
#include "scene/make.h"

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
    struct sb_yard yard = sb_yard_common;
    yard.side = 12;
    yard.tiles = 6;
    yard.triangles = 1600;
    yard.light[SB_LIGHT_POINT] = point_light;
    sb_yard_make(scene, &yard, variant);
}
