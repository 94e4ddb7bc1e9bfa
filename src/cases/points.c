#include "cases/points.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

void sb_points_init(struct sb_points *points, const struct sb_variant *variant)
{
    *points = (struct sb_points){.unified =
                                     variant->value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED};
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        for (int i = sb_lights_shining(variant, (enum sb_light_type)t); i > 0; i--) {
            assert(points->lights < SB_POINT_LIGHTS_MAX);
            points->type[points->lights++] = (enum sb_light_type)t;
        }
}

struct sb_points sb_points_like(const struct sb_points *points)
{
    struct sb_points like = *points;
    like.point = NULL;
    like.light = NULL;
    like.count = like.capacity = 0;
    return like;
}

void sb_points_free(struct sb_points *points)
{
    free(points->point);
    free(points->light);
    *points = (struct sb_points){0};
}

// --- points -------------------------------------------------------------------------------

static const struct sb_point plain_point = {
    .normal = {0, 0, 1},
    .eye = {0, 0, 1},
    .tangent = {1, 0, 0},
    .bitangent = {0, 1, 0},
    .material = {.diffuse = {1, 1, 1}, .specular = {1, 1, 1}, .shininess = 32},
    .texel = {{1, 1, 1}, {1, 1, 1}, {0.5f, 0.5f, 1}},
};

static struct sb_light plain_light(enum sb_light_type type)
{
    struct sb_light light = {
        .position = {0, 0, 1},
        .w = type == SB_LIGHT_DIR ? 0 : 1,
        .direction = {0, 0, -1},
        .range = 10,
        .intensity = 1,
        .diffuse = {1, 1, 1},
        .specular = {1, 1, 1},
        .constant = 1,
        .exponent = 8,
        .radius = 0.1f,
        .extent = {0.1f, 0.1f, 0.1f},
    };
    if (type == SB_LIGHT_AREA)
        memcpy(light.direction, (float[3]){0.1f, 0, 0}, sizeof light.direction);
    sb_light_set_cone(&light, SB_PI / 12, SB_PI / 6);
    return light;
}

struct sb_point *sb_points_add(struct sb_points *points)
{
    if (points->count == points->capacity) {
        points->capacity = points->capacity ? 2 * points->capacity : 64;
        const size_t count = (size_t)points->capacity;
        points->point = sb_realloc(points->point, count * sizeof *points->point);
        points->light = sb_realloc(points->light, (count * (size_t)points->lights + 1) *
                                                      sizeof *points->light);
    }
    const int number = points->count++;
    points->point[number] = plain_point;
    for (int i = 0; i < points->lights; i++)
        *sb_points_light(points, number, i) = plain_light(points->type[i]);
    return &points->point[number];
}

struct sb_light *sb_points_light(const struct sb_points *points, int point, int i)
{
    return &points->light[(size_t)point * (size_t)points->lights + (size_t)i];
}

// --- half precision -----------------------------------------------------------------------

float sb_round_half(double value)
{
    if (value == 0 || !isfinite(value))
        return (float)value;
    int exponent;
    frexp(value, &exponent);
    const int last = (exponent - 1 > -14 ? exponent - 1 : -14) - 10; // of 11 bits
    const double rounded = ldexp(nearbyint(ldexp(value, -last)), last);
    return fabs(rounded) >= 65520 ? (float)copysign(INFINITY, value) : (float)rounded;
}

static void round_floats(void *data, size_t size)
{
    float *value = data;
    for (size_t i = 0; i < size / sizeof *value; i++)
        value[i] = sb_round_half(value[i]);
}

void sb_points_round(struct sb_points *points)
{
    round_floats(points->point, (size_t)points->count * sizeof *points->point);
    for (int i = 0; i < points->count * points->lights; i++) {
        struct sb_light *light = &points->light[i];
        round_floats(light, sizeof *light);
        sb_light_set_cone(light, light->inner, light->cutoff);
    }
}

// A light as the shaders have it.
static struct sb_light as_lit(const struct sb_points *points, int p, int i)
{
    const struct sb_light *light = sb_points_light(points, p, i);
    return points->unified ? sb_light_unified(light, points->type[i]) : *light;
}

// --- the table ----------------------------------------------------------------------------

void sb_points_table(const struct sb_points *points, struct sb_image *table)
{
    const int floats = sb_row_floats(points->lights);
    sb_image_init(table, floats / 4, points->count, 4);
    for (int p = 0; p < points->count; p++) {
        float *row = table->data + (size_t)p * (size_t)floats;
        memcpy(row, &points->point[p], sizeof points->point[p]);
        for (int i = 0; i < points->lights; i++) {
            const struct sb_light light = as_lit(points, p, i);
            memcpy(row + sb_row_light(i), &light, sizeof light);
        }
    }
}

// --- as scenes ----------------------------------------------------------------------------

// A scene of no meshes that holds what one point is lit by.
static void put_scene(const struct sb_points *points, int p, struct sb_scene *scene)
{
    const struct sb_point *point = &points->point[p];
    *scene = (struct sb_scene){
        .name = "points", .material = &point->material, .material_count = 1};
    scene->lights.light = points->lights ? sb_points_light(points, p, 0) : NULL;
    for (int i = 0; i < points->lights; i++)
        scene->lights.count[points->type[i]]++;
    memcpy(scene->ambient, point->ambient, sizeof scene->ambient);
    memcpy(scene->camera.eye, point->eye, sizeof scene->camera.eye);
}

bool sb_points_validate(const struct sb_points *points, struct sb_error *err)
{
    for (int p = 0; p < points->count; p++) {
        struct sb_scene scene;
        put_scene(points, p, &scene);
        if (!sb_scene_validate(&scene, err))
            return false;
    }
    return true;
}

static struct sb_vec3 vec(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static void light_point(const struct sb_points *points, const struct sb_variant *variant,
                        int p, struct sb_points_truth *truth)
{
    const struct sb_point *point = &points->point[p];
    struct sb_light light[SB_POINT_LIGHTS_MAX];
    struct sb_scene scene;
    put_scene(points, p, &scene);
    struct sb_ref_shading shading = {
        .variant = variant, .scene = &scene, .lights = scene.lights, .ideal = true};
    for (int i = 0; i < points->lights; i++)
        light[i] = as_lit(points, p, i);
    shading.lights.light = light;
    struct sb_ref_input input = {
        .position = vec(point->position),
        .normal = vec(point->normal),
        .tangent = vec(point->tangent),
        .bitangent = vec(point->bitangent),
        .uv = {point->uv[0], point->uv[1]},
        .sampled = true,
    };
    for (int m = 0; m < SB_MAP_COUNT; m++)
        input.texel[m] = vec(point->texel[m]);
    sb_ref_shade(&shading, &input, &point->material, &truth->shade[p],
                 truth->terms + (size_t)p * (size_t)points->lights);
    truth->colour[p] = sb_ref_colour(&shading, &truth->shade[p], &input);
}

void sb_points_truth_make(const struct sb_points *points,
                          const struct sb_variant *variant, struct sb_points_truth *truth)
{
    const size_t count = (size_t)points->count;
    truth->shade = sb_alloc((count + 1) * sizeof *truth->shade);
    truth->colour = sb_alloc((count + 1) * sizeof *truth->colour);
    truth->terms = sb_alloc((count * (size_t)points->lights + 1) * sizeof *truth->terms);
    for (int p = 0; p < points->count; p++)
        light_point(points, variant, p, truth);
}

void sb_points_truth_free(struct sb_points_truth *truth)
{
    free(truth->shade);
    free(truth->colour);
    free(truth->terms);
    *truth = (struct sb_points_truth){0};
}
