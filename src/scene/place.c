#include "scene/make.h"

#include <string.h>

struct sb_placement sb_placement_of(const struct sb_variant *variant)
{
    return (struct sb_placement){
        .scale = variant->value[SB_AXIS_SCALE],
        .offset = variant->value[SB_AXIS_OFFSET],
        .aspect = variant->value[SB_AXIS_WIDTH] / variant->value[SB_AXIS_HEIGHT],
    };
}

double sb_triangles_wanted(const struct sb_variant *variant, double own)
{
    const double wanted = variant->value[SB_AXIS_TESSELLATION];
    return wanted > 0 ? wanted : own;
}

struct sb_vec3 sb_placed(const struct sb_placement *place, struct sb_vec3 point)
{
    const struct sb_vec3 offset = {place->offset, place->offset, place->offset};
    return sb_vec3_add(sb_vec3_scale(point, place->scale), offset);
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
    const struct sb_vec3 offset = {place->offset, place->offset, place->offset};
    const struct sb_mat4 placed =
        sb_mat4_multiply(sb_mat4_translation(offset),
                         sb_mat4_multiply(sb_mat4_scaling(place->scale), model));
    const struct sb_mat3 normal = sb_mat4_normal_matrix(placed);
    struct sb_draw draw = {.mesh = mesh, .material = material};
    store(draw.model, placed.m, 16);
    store(draw.normal_matrix, normal.m, 9);
    return draw;
}

static void *copy(struct sb_arena *arena, const void *data, size_t size)
{
    return memcpy(sb_arena_alloc(arena, size), data, size);
}

void sb_scene_fill(struct sb_scene *scene, const struct sb_scene_parts *parts,
                   const struct sb_variant *variant)
{
    struct sb_arena *arena = &scene->arena;
    const struct sb_placement place = sb_placement_of(variant);
    const float grey = parts->ambient, clear = parts->clear;
    scene->mesh =
        copy(arena, parts->mesh, (size_t)parts->mesh_count * sizeof *parts->mesh);
    scene->mesh_count = parts->mesh_count;
    scene->material = copy(arena, parts->material, sizeof *parts->material);
    scene->material_count = 1;
    scene->draw =
        copy(arena, parts->draw, (size_t)parts->draw_count * sizeof *parts->draw);
    scene->draw_count = parts->draw_count;
    memcpy(scene->ambient, (float[]){grey, grey, grey}, sizeof scene->ambient);
    memcpy(scene->clear_colour, (float[]){clear, clear, clear, 1},
           sizeof scene->clear_colour);
    scene->camera = sb_camera_make(&place, &parts->camera);
    sb_texture_make(arena, scene->map);
    sb_lights_make(scene, &place, parts->light, variant);
}
