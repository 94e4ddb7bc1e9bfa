// The tunnel of the GLSL wikibook's page on multiple lights, with the page's two lights, its
// material and its scene_ambient: a white light in front of the eye, and a red one that
// stands on the floor and shines up. Further lights, ours, hang under the ceiling. All fall
// off with 1 / distance, as the page has it.
#include "scene/make.h"

static const struct sb_corridor corridor = {.half = 2.5, .near_z = 5, .far_z = -25};
static const struct sb_vec3 eye = {0, 0, 4};

static struct sb_light_params dir_light(int i)
{
    return i == 0 ? sb_light_sun() : sb_light_across(i);
}

// From where the eye begins to see walls, to the end.
static double along(double at)
{
    return -3 + at * (corridor.far_z + 2 + 3);
}

static struct sb_light_params point_light(int i)
{
    if (i == 0)
        return (struct sb_light_params){
            .position = {0, 1, 2},
            .diffuse = {1, 1, 1},
            .specular = {1, 1, 1},
            .range = 30, // the page's has no end
            .linear = 1,
        };
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {(i % 2 ? 1 : -1) * (1.4 + 0.8 * at.x), 1 + 1.2 * at.y, along(at.z)},
        .range = 8,
        .linear = 1,
    };
    sb_light_colour(&light, i, 0.4);
    return light;
}

static struct sb_light_params spot_light(int i)
{
    if (i == 0)
        return (struct sb_light_params){
            .position = {0, -2, 0},
            .direction = {0, 1, 0},
            .diffuse = {2, 0, 0},
            .specular = {0.1, 0.1, 0.1},
            .range = 30,
            .linear = 1,
            .inner = 60 * SB_DEGREE, // the page's cone is hard
            .outer = 80 * SB_DEGREE,
            .exponent = 10,
        };
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {3 * (at.x - 0.5), corridor.half - 0.1, along(at.z)},
        .direction = {0.6 * (at.y - 0.5), -1, 0},
        .range = 12,
        .linear = 1,
        .inner = 20 * SB_DEGREE,
        .outer = 30 * SB_DEGREE,
        .exponent = 10,
    };
    sb_light_colour(&light, i, 0.8);
    return light;
}

// Away from the walls, so that no end of a segment is in one.
static struct sb_light_params area_light(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {2.4 * (at.x - 0.5), 0.4 + at.y, along(at.z)},
        .range = 8,
        .linear = 1,
    };
    sb_light_colour(&light, i, 0.4);
    sb_light_shape(&light, i);
    return light;
}

void sb_scene_tunnel(struct sb_scene *scene, const struct sb_variant *variant)
{
    const struct sb_placement place = sb_placement_of(variant, eye);
    struct sb_mesh mesh[SB_CORRIDOR_MESHES];
    struct sb_draw draw[SB_CORRIDOR_DRAWS];
    sb_corridor_make(&corridor, sb_triangles_wanted(variant, 800), &scene->arena, mesh);
    sb_corridor_place(&corridor, &place, draw);
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = mesh,
                      .mesh_count = SB_CORRIDOR_MESHES,
                      .material = &sb_corridor_material,
                      .material_count = 1,
                      .draw = draw,
                      .draw_count = SB_CORRIDOR_DRAWS,
                      .ambient = 0.2, // scene_ambient
                      .clear = 0.1,
                      .camera = {.eye = eye,
                                 .target = {0, 0, -1},
                                 .fov = 45 * SB_DEGREE,
                                 .near = 0.1,
                                 .far = 100},
                      .light = {dir_light, point_light, spot_light, area_light},
                  },
                  variant);
}
