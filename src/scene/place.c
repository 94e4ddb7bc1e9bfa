#include "scene/make.h"

#include <string.h>

#define LAMP_SIZE 0.2 // of the cube that shows a point light

struct sb_placement sb_placement_of(const struct sb_variant *variant, struct sb_vec3 eye)
{
    struct sb_placement place = {
        .scale = variant->value[SB_AXIS_SCALE],
        .offset = variant->value[SB_AXIS_OFFSET],
        .aspect = variant->value[SB_AXIS_WIDTH] / variant->value[SB_AXIS_HEIGHT],
    };
    if (variant->value[SB_AXIS_SPACE] == SB_SPACE_EYE)
        place.origin = sb_placed(&place, eye);
    return place;
}

double sb_triangles_wanted(const struct sb_variant *variant, double own)
{
    const double wanted = variant->value[SB_AXIS_TESSELLATION];
    return wanted > 0 ? wanted : own;
}

// Moved first and taken back then, as a program does whose world is kept in double: what the
// offset costs in double is part of the answer.
struct sb_vec3 sb_placed(const struct sb_placement *place, struct sb_vec3 point)
{
    const struct sb_vec3 offset = {place->offset, place->offset, place->offset};
    return sb_vec3_sub(sb_vec3_add(sb_vec3_scale(point, place->scale), offset),
                       place->origin);
}

static void store(float *out, const double *in, int count)
{
    for (int i = 0; i < count; i++)
        out[i] = (float)in[i];
}

struct sb_camera sb_camera_make(const struct sb_placement *place,
                                const struct sb_camera_params *params)
{
    const struct sb_vec3 eye = sb_placed(place, params->eye);
    const struct sb_vec3 up = {0, 1, 0};
    // Where it looks is taken from the unplaced points: at a scale of 1e-6 and an offset
    // of 1e12, eye and target are one point in double.
    struct sb_mat4 view = sb_mat4_look_at((struct sb_vec3){0},
                                          sb_vec3_sub(params->target, params->eye), up);
    view = sb_mat4_multiply(view, sb_mat4_translation(sb_vec3_scale(eye, -1)));
    const double fov_y =
        place->aspect < 1 ? 2 * atan(tan(params->fov / 2) / place->aspect) : params->fov;
    const struct sb_mat4 projection = sb_mat4_perspective(
        fov_y, place->aspect, params->near * place->scale, params->far * place->scale);
    const struct sb_mat4 both = sb_mat4_multiply(projection, view);

    struct sb_camera camera = {.eye = {(float)eye.x, (float)eye.y, (float)eye.z}};
    store(camera.view, view.m, 16);
    store(camera.projection, projection.m, 16);
    store(camera.view_projection, both.m, 16);
    return camera;
}

struct sb_draw sb_draw_make(const struct sb_placement *place, int mesh, int material,
                            struct sb_mat4 model)
{
    struct sb_mat4 placed = sb_mat4_multiply(sb_mat4_scaling(place->scale), model);
    const struct sb_vec3 at =
        sb_placed(place, (struct sb_vec3){model.m[12], model.m[13], model.m[14]});
    placed.m[12] = at.x;
    placed.m[13] = at.y;
    placed.m[14] = at.z;
    const struct sb_mat3 normal = sb_mat4_normal_matrix(placed);
    struct sb_draw draw = {.mesh = mesh, .material = material, .lamp = -1};
    store(draw.model, placed.m, 16);
    store(draw.normal_matrix, normal.m, 9);
    return draw;
}

// Behind the scene's own draws come the lamps, and behind its meshes their cube. A tessellated
// cube would add thousands of triangles that nothing is computed for.
static void copy_draws(struct sb_scene *scene, const struct sb_scene_parts *parts,
                       const struct sb_placement *place, const sb_light_maker point,
                       int lamps)
{
    struct sb_arena *arena = &scene->arena;
    const int meshes = parts->mesh_count + (lamps > 0), draws = parts->draw_count + lamps;
    struct sb_mesh *mesh = sb_arena_alloc(arena, (size_t)meshes * sizeof *mesh);
    struct sb_draw *draw = sb_arena_alloc(arena, (size_t)draws * sizeof *draw);
    memcpy(mesh, parts->mesh, (size_t)parts->mesh_count * sizeof *mesh);
    memcpy(draw, parts->draw, (size_t)parts->draw_count * sizeof *draw);
    if (lamps > 0)
        mesh[parts->mesh_count] = sb_mesh_cube(arena, 1);
    for (int i = 0; i < lamps; i++) {
        const struct sb_mat4 model = sb_mat4_multiply(
            sb_mat4_translation(point(i).position), sb_mat4_scaling(LAMP_SIZE));
        draw[parts->draw_count + i] = sb_draw_make(place, parts->mesh_count, 0, model);
        draw[parts->draw_count + i].lamp = i;
    }
    scene->mesh = mesh;
    scene->draw = draw;
    scene->mesh_count = meshes;
    scene->draw_count = draws;
}

// `shininess`: of all of them; 0: each has its own.
static void copy_materials(struct sb_scene *scene, const struct sb_scene_parts *parts,
                           double shininess)
{
    const size_t size = (size_t)parts->material_count * sizeof *parts->material;
    struct sb_material *material =
        memcpy(sb_arena_alloc(&scene->arena, size), parts->material, size);
    for (int i = 0; shininess > 0 && i < parts->material_count; i++)
        material[i].shininess = (float)shininess;
    scene->material = material;
    scene->material_count = parts->material_count;
}

void sb_scene_fill(struct sb_scene *scene, const struct sb_scene_parts *parts,
                   const struct sb_variant *variant)
{
    struct sb_arena *arena = &scene->arena;
    const struct sb_placement place = sb_placement_of(variant, parts->camera.eye);
    struct sb_vec3 ambient = {parts->ambient, parts->ambient, parts->ambient};
    struct sb_vec3 clear = {parts->clear, parts->clear, parts->clear};
    sb_background_tint(&ambient, &clear, variant);
    store(scene->ambient, (double[]){ambient.x, ambient.y, ambient.z}, 3);
    store(scene->clear_colour, (double[]){clear.x, clear.y, clear.z, 1}, 4);
    copy_materials(scene, parts, variant->value[SB_AXIS_SHININESS]);
    scene->camera = sb_camera_make(&place, &parts->camera);
    sb_texture_make(arena, scene->map);
    sb_lights_make(scene, &place, parts->light, variant);
    const bool lamps = variant->value[SB_AXIS_LAMPS] == SB_LAMPS_ON;
    copy_draws(scene, parts, &place, parts->light[SB_LIGHT_POINT],
               lamps ? scene->lights.count[SB_LIGHT_POINT] : 0);
}
