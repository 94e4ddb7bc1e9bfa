// A corridor seen from inside: subway lights of limited reach along both of its walls.
#include "scene/make.h"

static const struct sb_vec3 eye = {0, 0, 0};

static const struct sb_corridor corridor = {.half = 2, .near_z = 1, .far_z = -23};

static struct sb_light_params dir_light(int i)
{
    return i == 0 ? sb_light_sun() : sb_light_across(i);
}

// Along both sides, under the ceiling, from where the eye begins to see walls to the end.
static struct sb_vec3 beside_wall(struct sb_vec3 at, int i)
{
    return (struct sb_vec3){
        .x = (i % 2 ? 1 : -1) * (1.4 + 0.4 * at.x),
        .y = 1 + 0.8 * at.y,
        .z = -4 + at.z * (corridor.far_z + 0.5 + 4),
    };
}

static struct sb_light_params point_light(int i)
{
    struct sb_light_params light = {
        .position = beside_wall(sb_light_spread(i), i),
        .range = 7, // with the numbers that the series of `containers` gives for it
        .constant = 1,
        .linear = 0.7,
        .quadratic = 1.8,
    };
    sb_light_colour(&light, i, 0.5);
    return light;
}

// From just under the ceiling, down at the floor.
static struct sb_light_params spot_light(int i)
{
    const struct sb_vec3 at = sb_light_spread(i);
    struct sb_light_params light = {
        .position = {2.4 * (at.x - 0.5), corridor.half - 0.1,
                     -6 + at.z * (corridor.far_z + 2 + 6)},
        .direction = {0.6 * (at.y - 0.5), -1, 0},
        .range = 13, // likewise
        .constant = 1,
        .linear = 0.35,
        .quadratic = 0.44,
        .inner = 20 * SB_DEGREE,
        .outer = 30 * SB_DEGREE,
        .exponent = 8,
    };
    sb_light_colour(&light, i, 0.8);
    return light;
}

// Away from the walls, so that no end of a segment is in one.
static struct sb_light_params area_light(int i)
{
    struct sb_light_params light = point_light(i);
    light.position.x *= 0.5;
    light.position.y *= 0.5;
    light.position.z *= 0.95;
    sb_light_shape(&light, i);
    return light;
}

void sb_scene_plane(struct sb_scene *scene, const struct sb_variant *variant)
{
    const struct sb_placement place = sb_placement_of(variant, eye);
    struct sb_mesh mesh[SB_CORRIDOR_MESHES];
    struct sb_draw draw[SB_CORRIDOR_DRAWS];
    sb_corridor_make(&corridor, sb_triangles_wanted(variant, 200), &scene->arena, mesh);
    sb_corridor_place(&corridor, &place, draw);
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = mesh,
                      .mesh_count = SB_CORRIDOR_MESHES,
                      .material = &sb_corridor_material,
                      .material_count = 1,
                      .draw = draw,
                      .draw_count = SB_CORRIDOR_DRAWS,
                      .ambient = 0.2, // the page's scene_ambient
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
