#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/text.h"
#include "math/vec.h"
#include "scene/scene.h"

// Differences of places have a square: (2 sqrt(3) 1e18)^2 = 1.2e37 is a float, while from
// 1.8e19 on a distance has an infinite one, and no direction.
#define SB_PLACE_MAX 1e18

// Closed intervals of floats; the largest float below 1 is 1 - 2^-24.
static const struct {
    double min, max;
    const char *words;
} ranges[] = {
    [SB_FINITE] = {-FLT_MAX, FLT_MAX, "a finite number"},
    [SB_PLACE] = {-SB_PLACE_MAX, SB_PLACE_MAX, "-1e18 to 1e18"},
    [SB_NOT_NEGATIVE] = {0, FLT_MAX, "a finite number of 0 or more"},
    [SB_COSINE] = {-1 + 0x1p-24, 1 - 0x1p-24,
                   "more than -1 and less than 1; or -2, no cone"},
    [SB_HALF_ANGLE] = {0, (float)SB_PI, "0 or more, at most pi"},
    [SB_SHININESS] = {1e-3f, FLT_MAX, "a finite number of 0.001 or more"},
};

// clang-format off
#define FIELD(type, name, components, range) \
    {#name, offsetof(struct type, name), components, range, ""}

static const struct sb_light_field vertex_fields[] = {
    FIELD(sb_vertex, position, 3, SB_FINITE),
    FIELD(sb_vertex, normal,   3, SB_FINITE),
    FIELD(sb_vertex, uv,       2, SB_FINITE),
    FIELD(sb_vertex, tangent,  4, SB_FINITE),
};
static const struct sb_light_field material_fields[] = {
    FIELD(sb_material, ambient,   3, SB_NOT_NEGATIVE),
    FIELD(sb_material, diffuse,   3, SB_NOT_NEGATIVE),
    FIELD(sb_material, specular,  3, SB_NOT_NEGATIVE),
    FIELD(sb_material, shininess, 1, SB_SHININESS),
};
static const struct sb_light_field draw_fields[] = {
    FIELD(sb_draw, model,        16, SB_FINITE),
    FIELD(sb_draw, normal_matrix, 9, SB_FINITE),
};
static const struct sb_light_field scene_fields[] = {
    FIELD(sb_scene, ambient,                3, SB_NOT_NEGATIVE),
    FIELD(sb_scene, clear_colour,           4, SB_NOT_NEGATIVE),
    FIELD(sb_scene, camera.eye,             3, SB_PLACE),
    FIELD(sb_scene, camera.view,           16, SB_FINITE),
    FIELD(sb_scene, camera.projection,     16, SB_FINITE),
    FIELD(sb_scene, camera.view_projection, 16, SB_FINITE),
};
// clang-format on

// What is being looked at, for messages: "scene containers, point light 3", or
// "scene containers, vertex 7 of mesh 0", or the scene itself where noun is NULL.
struct subject {
    const char *scene, *noun;
    int number;
    const int *mesh; // that a vertex is one of
};

static bool __attribute__((format(printf, 3, 4)))
fail(const struct subject *it, struct sb_error *err, const char *format, ...)
{
    struct sb_text text = {0};
    sb_text_printf(&text, "scene %s", it->scene);
    if (it->noun)
        sb_text_printf(&text, ", %s %d", it->noun, it->number);
    if (it->mesh)
        sb_text_printf(&text, " of mesh %d", *it->mesh);
    sb_text_add(&text, ": ");
    va_list args;
    va_start(args, format);
    sb_text_vprintf(&text, format, args);
    va_end(args);
    sb_fail(err, SB_BAD_INPUT, "%s", sb_text_get(&text));
    sb_text_free(&text);
    return false;
}

static bool check_fields(const struct subject *it, const void *data,
                         const struct sb_light_field *fields, size_t count,
                         struct sb_error *err)
{
    for (const struct sb_light_field *field = fields; field < fields + count; field++) {
        const float *value = (const float *)((const char *)data + field->offset);
        for (int i = 0; i < field->components; i++) {
            if (value[i] >= ranges[field->range].min &&
                value[i] <= ranges[field->range].max)
                continue;
            if (field->range == SB_COSINE && value[i] == SB_COS_NO_CONE)
                continue;
            char number[32], component[16] = "";
            if (field->components > 1)
                snprintf(component, sizeof component, "[%d]", i);
            return fail(it, err, "%s%s is %s; valid: %s", field->name, component,
                        isnan(value[i]) ? "nan" : sb_number_text(value[i], number),
                        ranges[field->range].words);
        }
    }
    return true;
}
#define CHECK_FIELDS(it, data, fields, err)                                              \
    check_fields(it, data, fields, sizeof(fields) / sizeof *(fields), err)

// --- what no field can tell alone ------------------------------------------------------

static bool check_direction(const struct subject *it, const struct sb_light *light,
                            struct sb_error *err)
{
    const float *direction = light->direction;
    if (direction[0] != 0 || direction[1] != 0 || direction[2] != 0)
        return true;
    return fail(it, err, "direction is 0, 0, 0; valid: any other length");
}

static bool check_attenuation(const struct subject *it, const struct sb_light *light,
                              struct sb_error *err)
{
    if (light->constant > 0 || light->linear > 0 || light->quadratic > 0)
        return true;
    return fail(it, err,
                "constant, linear and quadratic are all 0, which divides by 0; valid: at "
                "least one above 0");
}

// The direction of an area light matters to some shapes only, and even there 0 is a ball.
static bool check_light(const struct subject *it, enum sb_light_type type,
                        const struct sb_light *light, struct sb_error *err)
{
    const struct sb_light_struct *row = &sb_light_structs[type];
    if (!check_fields(it, light, row->field, (size_t)row->field_count, err))
        return false;
    if ((type == SB_LIGHT_DIR || type == SB_LIGHT_SPOT) &&
        !check_direction(it, light, err))
        return false;
    return type == SB_LIGHT_DIR || check_attenuation(it, light, err);
}

static bool check_lights(const struct sb_scene *scene, struct sb_error *err)
{
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const int count = scene->lights.count[type];
        const char *name = sb_light_structs[type].name;
        if (count < 0 || (count > 0 && !scene->lights.light))
            return fail(
                &(struct subject){.scene = scene->name}, err,
                "%d in the list of %ss, which is %s; valid: 0, or a list of as many",
                count, name, scene->lights.light ? "there" : "NULL");
    }
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        int count;
        const struct sb_light *light = sb_lights_of(&scene->lights, type, &count);
        for (int i = 0; i < count; i++) {
            const struct subject it = {scene->name, sb_light_structs[type].name, i, NULL};
            if (!check_light(&it, type, &light[i], err))
                return false;
        }
    }
    return true;
}

// --- meshes, draws, maps ---------------------------------------------------------------

static bool check_mesh(const struct sb_scene *scene, int number, struct sb_error *err)
{
    const struct sb_mesh *mesh = &scene->mesh[number];
    const struct subject it = {scene->name, "mesh", number, NULL};
    if (mesh->vertex_count < 3 || mesh->index_count < 3 || mesh->index_count % 3 != 0)
        return fail(&it, err,
                    "%d vertices and %d indices; valid: 3 or more, and three indices a "
                    "triangle",
                    mesh->vertex_count, mesh->index_count);
    for (int i = 0; i < mesh->index_count; i++) {
        if (mesh->index[i] >= (uint32_t)mesh->vertex_count)
            return fail(&it, err, "index[%d] is %lu; valid: less than %d, the vertices",
                        i, (unsigned long)mesh->index[i], mesh->vertex_count);
    }
    for (int i = 0; i < mesh->vertex_count; i++) {
        const struct subject vertex = {scene->name, "vertex", i, &number};
        if (!CHECK_FIELDS(&vertex, &mesh->vertex[i], vertex_fields, err))
            return false;
    }
    return true;
}

// Where the model matrix, which is column-major, puts the vertices of a draw.
static bool check_placed(const struct subject *it, const struct sb_draw *draw,
                         const struct sb_mesh *mesh, struct sb_error *err)
{
    const float *m = draw->model;
    for (int i = 0; i < mesh->vertex_count; i++) {
        const float *v = mesh->vertex[i].position;
        for (int r = 0; r < 3; r++) {
            const double place = (double)m[r] * v[0] + (double)m[4 + r] * v[1] +
                                 (double)m[8 + r] * v[2] + m[12 + r];
            if (!(fabs(place) <= SB_PLACE_MAX))
                return fail(it, err, "vertex %d is placed at %g; valid: %s", i, place,
                            ranges[SB_PLACE].words);
        }
    }
    return true;
}

static bool check_draw(const struct sb_scene *scene, int number, struct sb_error *err)
{
    const struct sb_draw *draw = &scene->draw[number];
    const struct subject it = {scene->name, "draw", number, NULL};
    if (draw->mesh < 0 || draw->mesh >= scene->mesh_count)
        return fail(&it, err, "mesh is %d; valid: 0 or more, less than %d", draw->mesh,
                    scene->mesh_count);
    if (draw->material < 0 || draw->material >= scene->material_count)
        return fail(&it, err, "material is %d; valid: 0 or more, less than %d",
                    draw->material, scene->material_count);
    return CHECK_FIELDS(&it, draw, draw_fields, err) &&
           check_placed(&it, draw, &scene->mesh[draw->mesh], err);
}

static bool check_map(const struct sb_scene *scene, int number, struct sb_error *err)
{
    const struct sb_texture *map = &scene->map[number];
    const struct subject it = {scene->name, "map", number, NULL};
    if (map->texel && (map->width < 1 || map->height < 1))
        return fail(&it, err, "%d x %d texels; valid: 1 x 1 or more", map->width,
                    map->height);
    return true;
}

bool sb_scene_validate(const struct sb_scene *scene, struct sb_error *err)
{
    for (int i = 0; i < scene->mesh_count; i++) {
        if (!check_mesh(scene, i, err))
            return false;
    }
    for (int i = 0; i < scene->material_count; i++) {
        const struct subject it = {scene->name, "material", i, NULL};
        const unsigned lacks = scene->material[i].lacks;
        if (!CHECK_FIELDS(&it, &scene->material[i], material_fields, err))
            return false;
        if (lacks >> SB_MAP_COUNT)
            return fail(&it, err, "lacks is %u; valid: 0 to %u, a bit for each map",
                        lacks, (1U << SB_MAP_COUNT) - 1);
    }
    for (int i = 0; i < scene->draw_count; i++) {
        if (!check_draw(scene, i, err))
            return false;
    }
    for (int i = 0; i < SB_MAP_COUNT; i++) {
        if (!check_map(scene, i, err))
            return false;
    }
    const struct subject all = {.scene = scene->name};
    return CHECK_FIELDS(&all, scene, scene_fields, err) && check_lights(scene, err);
}
