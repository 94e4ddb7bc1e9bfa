// A field of blocks on the ground, seen from a little above, for the LWJGL book's chapter on
// lights: a sun that goes over it from dawn to dusk (axis `sun`), and some lamps. Its material
// is one colour and a reflectance.
#include "scene/make.h"

enum { ROWS = 5, BLOCKS = ROWS * ROWS };

#define PITCH       2.2
#define SIDE        14.0 // of the ground
#define REFLECTANCE 0.5f

static const struct sb_vec3 eye = {0, 5.5, 10.5};

// A little to the right and to the front of noon, so that walls are lit as well.
static struct sb_light_params dir_light(int i)
{
    if (i == 0)
        return (struct sb_light_params){
            .direction = {-0.35, -1, -0.5},
            .ambient = {0.05, 0.05, 0.05},
            .diffuse = {0.8, 0.8, 0.8},
            .specular = {0.8, 0.8, 0.8},
        };
    // From above and from the front, where it falls on tops or on walls that the eye sees.
    const struct sb_vec3 at = sb_light_spread(i);
    const struct sb_vec3 to_light =
        sb_light_cap((struct sb_vec3){0, 1, 0.8}, 0.5, at.x, at.y);
    struct sb_light_params light = {.direction = sb_vec3_scale(to_light, -1)};
    sb_light_colour(&light, i, 0.1);
    return light;
}

static struct sb_light_params point_light(int i)
{
    return sb_light_above(i, 0.3);
}

static struct sb_vec3 middle_of_block(int i, double size)
{
    return (struct sb_vec3){(i % ROWS - ROWS / 2) * PITCH, size / 2,
                            (i / ROWS - ROWS / 2) * PITCH};
}

// Down at block i mod 25, whose top the eye sees.
static struct sb_light_params spot_light(int i)
{
    struct sb_light_params light = sb_light_above(i, 1.5);
    const struct sb_vec3 block = middle_of_block(i % BLOCKS, 1);
    light.position.x = block.x + 0.15 * light.position.x;
    light.position.z = block.z + 0.15 * light.position.z;
    light.direction = sb_vec3_sub(block, light.position);
    light.inner = 20 * SB_DEGREE;
    light.outer = 30 * SB_DEGREE;
    light.exponent = 8;
    return light;
}

static struct sb_light_params area_light(int i)
{
    struct sb_light_params light = sb_light_above(i, 1);
    sb_light_shape(&light, i);
    return light;
}

// Turned and of different sizes, so that walls face all ways.
static struct sb_draw block(const struct sb_placement *place, int i)
{
    const double size = 0.9 + 0.5 * sb_light_spread(i).x;
    const struct sb_mat4 turned =
        sb_mat4_multiply(sb_mat4_rotation(37 * i * SB_DEGREE, (struct sb_vec3){0, 1, 0}),
                         sb_mat4_scaling(size));
    return sb_draw_make(
        place, 0, 0,
        sb_mat4_multiply(sb_mat4_translation(middle_of_block(i, size)), turned));
}

void sb_scene_blocks(struct sb_scene *scene, const struct sb_variant *variant)
{
    static const struct sb_material material = {
        .ambient = {0.55f, 0.65f, 0.5f},
        .diffuse = {0.55f, 0.65f, 0.5f},
        .specular = {REFLECTANCE, REFLECTANCE, REFLECTANCE},
        .shininess = 10,
    };
    // Half of them for the blocks, as near as whole cells allow, the rest for the ground.
    const double triangles = sb_triangles_wanted(variant, 1200);
    const double cells = fmax(1, round(sqrt(triangles / 2 / (12 * BLOCKS))));
    const double rest = triangles - 12 * BLOCKS * cells * cells;
    const int squares = (int)fmax(1, round(sqrt(fmax(rest, 0) / 2)));

    const struct sb_placement place = sb_placement_of(variant, eye);
    const struct sb_mesh mesh[2] = {
        sb_mesh_cube(&scene->arena, (int)cells),
        sb_mesh_plane(&scene->arena, SIDE, SIDE, squares, squares),
    };
    struct sb_draw draw[BLOCKS + 1];
    for (int i = 0; i < BLOCKS; i++)
        draw[i] = block(&place, i);
    // The front of the plane, +z, goes up: columns x, -z, y.
    const struct sb_mat4 ground = {{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}};
    draw[BLOCKS] = sb_draw_make(&place, 1, 0, ground);
    sb_scene_fill(scene,
                  &(struct sb_scene_parts){
                      .mesh = mesh,
                      .mesh_count = 2,
                      .material = &material,
                      .material_count = 1,
                      .draw = draw,
                      .draw_count = BLOCKS + 1,
                      .ambient = 0.3,
                      .clear = 0.1,
                      .camera = {.eye = eye,
                                 .target = {0, 0, -0.5},
                                 .fov = 45 * SB_DEGREE,
                                 .near = 0.1,
                                 .far = 100},
                      .light = {dir_light, point_light, spot_light, area_light},
                  },
                  variant);
}
