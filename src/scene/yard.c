// A yard: a ground of tiles, with cubes and balls on it.
#include "scene/make.h"

struct sb_light_params sb_yard_dir(int i)
{
    if (i == 0)
        return sb_light_sun();
    const struct sb_vec3 at = sb_light_spread(i);
    const struct sb_vec3 to_light =
        sb_light_cap((struct sb_vec3){0, 1, 0.8}, 0.5, at.x, at.y);
    struct sb_light_params light = {.direction = sb_vec3_scale(to_light, -1)};
    sb_light_colour(&light, i, 0.1);
    return light;
}

struct sb_light_params sb_yard_point(int i)
{
    return sb_light_above(i, 0.3);
}

struct sb_light_params sb_yard_spot(int i)
{
    struct sb_light_params light = sb_light_above(i, 1);
    const struct sb_vec3 below = {0.8 * light.position.x, 0, 0.8 * light.position.z};
    light.direction = sb_vec3_sub(below, light.position);
    light.inner = 25 * SB_DEGREE;
    light.outer = 35 * SB_DEGREE;
    light.exponent = 8;
    return light;
}

struct sb_light_params sb_yard_area(int i)
{
    struct sb_light_params light = sb_light_above(i, 1);
    sb_light_shape(&light, i);
    return light;
}

// --- what most yards have ----------------------------------------------------------------

static const struct sb_material material[] = {
    {{0.35f, 0.36f, 0.33f}, {0.35f, 0.36f, 0.33f}, {0.05f, 0.05f, 0.05f}, 8, 0},
    {{0.6f, 0.2f, 0.15f}, {0.6f, 0.2f, 0.15f}, {0.4f, 0.4f, 0.4f}, 32, 0},
    {{0.2f, 0.3f, 0.65f}, {0.2f, 0.3f, 0.65f}, {0.5f, 0.5f, 0.5f}, 48, 0},
    {{0.7f, 0.6f, 0.4f}, {0.7f, 0.6f, 0.4f}, {0.2f, 0.2f, 0.2f}, 16, 0},
    {{0.4f, 0.4f, 0.42f}, {0.4f, 0.4f, 0.42f}, {0.8f, 0.8f, 0.8f}, 96, 0},
};

// x, z, size, turn, ball, material
static const struct sb_yard_object object[] = {
    {-3.6, -2.4, 1.4, 20, false, 1}, {-1.5, -3.2, 1, 0, true, 2},
    {1.2, -3, 1.2, 50, false, 3},    {3.5, -2.2, 1.3, 0, true, 4},
    {-2.6, 0.2, 1, 70, false, 2},    {-0.2, -0.6, 0.9, 0, true, 1},
    {2.3, 0.1, 1.1, 35, false, 4},   {4.3, 1.2, 0.8, 0, true, 3},
    {-4.2, 2.2, 0.8, 10, false, 3},  {-1.4, 2.6, 0.7, 0, true, 4},
    {1, 2.9, 0.8, 60, false, 1},     {3, 3.2, 0.6, 0, true, 2},
};

const struct sb_yard sb_yard_common = {
    .side = 14,
    .tiles = 1,
    .object = object,
    .object_count = sizeof object / sizeof *object,
    .material = material,
    .material_count = sizeof material / sizeof *material,
    .triangles = 1200,
    .ambient = 0.1,
    .camera = {.eye = {0, 5.5, 10.5},
               .target = {0, 0, -0.5},
               .fov = 45 * SB_DEGREE,
               .near = 0.1,
               .far = 100},
    .light = {sb_yard_dir, sb_yard_point, sb_yard_spot, sb_yard_area},
};

// --- making one --------------------------------------------------------------------------

enum { CUBE, BALL, TILE, MESHES };

// The front of a plane, +z, goes up: columns x, -z, y.
static struct sb_mat4 tile_at(const struct sb_yard *yard, int number)
{
    const double side = yard->side / yard->tiles;
    const double x = (number % yard->tiles + 0.5) * side - yard->side / 2;
    const double z = (number / yard->tiles + 0.5) * side - yard->side / 2;
    const struct sb_mat4 flat = {{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, x, 0, z, 1}};
    return flat;
}

static struct sb_mat4 object_at(const struct sb_yard_object *it)
{
    const struct sb_vec3 up = {0, 1, 0}, at = {it->x, it->size / 2, it->z};
    const double scale = it->ball ? it->size / 2 : it->size; // a ball has radius 1
    return sb_mat4_multiply(sb_mat4_translation(at),
                            sb_mat4_multiply(sb_mat4_rotation(it->turn * SB_DEGREE, up),
                                             sb_mat4_scaling(scale)));
}

// Half of the triangles for the ground, the rest for what stands on it.
static void make_meshes(const struct sb_yard *yard, double triangles,
                        struct sb_arena *arena, struct sb_mesh mesh[MESHES])
{
    const double each = triangles / 2 / fmax(yard->object_count, 1);
    const double side = yard->side / yard->tiles;
    const double cells = sqrt(triangles / 4) / yard->tiles;
    int stacks, slices;
    sb_sphere_cells(each, &stacks, &slices);
    mesh[CUBE] = sb_mesh_cube(arena, (int)fmax(1, round(sqrt(each / 12))));
    mesh[BALL] = sb_mesh_sphere(arena, stacks, slices);
    mesh[TILE] = sb_mesh_plane(arena, side, side, (int)fmax(1, round(cells)),
                               (int)fmax(1, round(cells)));
}

void sb_yard_make(struct sb_scene *scene, const struct sb_yard *yard,
                  const struct sb_variant *variant)
{
    const struct sb_placement place = sb_placement_of(variant, yard->camera.eye);
    const int tiles = yard->tiles * yard->tiles, draws = yard->object_count + tiles;
    struct sb_draw *draw = sb_arena_alloc(&scene->arena, (size_t)draws * sizeof *draw);
    struct sb_mesh mesh[MESHES];
    make_meshes(yard, sb_triangles_wanted(variant, yard->triangles), &scene->arena, mesh);
    for (int i = 0; i < yard->object_count; i++)
        draw[i] = sb_draw_make(&place, yard->object[i].ball ? BALL : CUBE,
                               yard->object[i].material, object_at(&yard->object[i]));
    for (int i = 0; i < tiles; i++)
        draw[yard->object_count + i] = sb_draw_make(&place, TILE, 0, tile_at(yard, i));
    sb_scene_fill(
        scene,
        &(struct sb_scene_parts){
            .mesh = mesh,
            .mesh_count = MESHES,
            .material = yard->material,
            .material_count = yard->material_count,
            .draw = draw,
            .draw_count = draws,
            .ambient = yard->ambient,
            .clear = 0.02,
            .camera = yard->camera,
            .light = {yard->light[0], yard->light[1], yard->light[2], yard->light[3]},
        },
        variant);
}
