// Eight spheres in two rows of four, each of its own material: the scene for material blocks,
// which the text of uniform blocks has one of for each object. Lit from the eye's side.
#include "scene/make.h"

enum { SPHERES = 8, COLUMNS = 4 };

static const double pitch_x = 2.1, pitch_y = 2.8; // radius 1
static const struct sb_vec3 eye = {0, 0, 10.5};

// No component of `diffuse` is below a tenth, so that no sphere is blind to a light.
static const struct sb_material material[SPHERES] = {
    {{0.2f, 0.04f, 0.04f}, {0.8f, 0.15f, 0.12f}, {0.7f, 0.6f, 0.6f}, 76, 0},
    {{0.05f, 0.2f, 0.06f}, {0.15f, 0.7f, 0.2f}, {0.6f, 0.7f, 0.6f}, 48, 0},
    {{0.04f, 0.06f, 0.22f}, {0.12f, 0.2f, 0.8f}, {0.3f, 0.3f, 0.5f}, 16, 0},
    {{0.2f, 0.16f, 0.03f}, {0.75f, 0.6f, 0.2f}, {0.63f, 0.56f, 0.37f}, 51, 0},
    {{0.19f, 0.19f, 0.2f}, {0.5f, 0.5f, 0.52f}, {0.9f, 0.9f, 0.9f}, 96, 0},
    {{0.21f, 0.1f, 0.05f}, {0.7f, 0.35f, 0.18f}, {0.26f, 0.14f, 0.09f}, 12, 0},
    {{0.1f, 0.2f, 0.2f}, {0.3f, 0.7f, 0.68f}, {0.31f, 0.31f, 0.31f}, 24, 0},
    {{0.22f, 0.22f, 0.2f}, {0.85f, 0.84f, 0.8f}, {0.1f, 0.1f, 0.1f}, 6, 0},
};

static struct sb_vec3 centre(int sphere)
{
    return (struct sb_vec3){(sphere % COLUMNS - 0.5 * (COLUMNS - 1)) * pitch_x,
                            sphere / COLUMNS == 0 ? pitch_y / 2 : -pitch_y / 2, 0};
}

static struct sb_light_params dir_light(int i)
{
    return i == 0 ? sb_light_sun() : sb_light_from_front(i);
}

// At `distance` from the middle of sphere i mod 8, in a direction at most acos(cos_limit) from
// +z, where the eye sees all of the sphere.
static struct sb_light_params light_before(int i, double cos_limit, double distance)
{
    const struct sb_vec3 at = sb_light_spread(i);
    const struct sb_vec3 way =
        sb_light_cap((struct sb_vec3){0, 0, 1}, cos_limit, at.x, at.y);
    struct sb_light_params light = {
        .position = sb_vec3_add(centre(i % SPHERES), sb_vec3_scale(way, distance + at.z)),
        .range = 20,
        .constant = 1,
        .linear = 0.22,
        .quadratic = 0.2,
    };
    sb_light_colour(&light, i, 0.4);
    return light;
}

// The neighbours' middles are a pitch away: a light at 60 degrees comes no closer than 1.05.
static struct sb_light_params point_light(int i)
{
    return light_before(i, 0.5, 1.5);
}

static struct sb_light_params spot_light(int i)
{
    struct sb_light_params light = point_light(i);
    light.direction = sb_vec3_sub(centre(i % SPHERES), light.position);
    light.inner = 15 * SB_DEGREE;
    light.outer = 25 * SB_DEGREE;
    light.exponent = 8;
    return light;
}

// So far in front of the rows that no part of it is inside a sphere.
static struct sb_light_params area_light(int i)
{
    struct sb_light_params light = light_before(i, 0.87, 2.25);
    sb_light_shape(&light, i);
    return light;
}

void sb_scene_spheres(struct sb_scene *scene, const struct sb_variant *variant)
{
    const struct sb_placement place = sb_placement_of(variant, eye);
    int stacks, slices;
    sb_sphere_cells(sb_triangles_wanted(variant, 500 * SPHERES) / SPHERES, &stacks,
                    &slices);
    const struct sb_mesh mesh = sb_mesh_sphere(&scene->arena, stacks, slices);
    struct sb_draw draw[SPHERES];
    for (int i = 0; i < SPHERES; i++)
        draw[i] = sb_draw_make(&place, 0, i, sb_mat4_translation(centre(i)));
    sb_scene_fill(
        scene,
        &(struct sb_scene_parts){
            .mesh = &mesh,
            .mesh_count = 1,
            .material = material,
            .material_count = SPHERES,
            .draw = draw,
            .draw_count = SPHERES,
            .ambient = 0.2,
            .clear = 0.1,
            .camera = {.eye = eye, .fov = 45 * SB_DEGREE, .near = 0.1, .far = 100},
            .light = {dir_light, point_light, spot_light, area_light},
        },
        variant);
}
