#include "measure/dump.h"

#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "base/file.h"
#include "scene/scene.h"

// --- the scene ---------------------------------------------------------------------------

// 9 significant digits tell all floats apart (IEEE 754-2019, 5.12.2); the reader rounds to
// float what it read as double.
enum { FLOAT_DIGITS = 9 };

static json_t *numbers(const float *value, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, json_real(value[i]));
    return list;
}

// One member of all vertices, behind each other.
static json_t *vertex_member(const struct sb_mesh *mesh, size_t offset, int components)
{
    json_t *list = json_array();
    for (int v = 0; v < mesh->vertex_count; v++) {
        float value[4];
        memcpy(value, (const char *)&mesh->vertex[v] + offset,
               (size_t)components * sizeof *value);
        for (int i = 0; i < components; i++)
            json_array_append_new(list, json_real(value[i]));
    }
    return list;
}

static json_t *mesh_json(const struct sb_mesh *mesh)
{
    json_t *index = json_array();
    for (int i = 0; i < mesh->index_count; i++)
        json_array_append_new(index, json_integer(mesh->index[i]));
#define MEMBER(name, components)                                                         \
    vertex_member(mesh, offsetof(struct sb_vertex, name), components)
    return json_pack("{so so so so so}", "position", MEMBER(position, 3), "normal",
                     MEMBER(normal, 3), "uv", MEMBER(uv, 2), "tangent",
                     MEMBER(tangent, 4), "index", index);
#undef MEMBER
}

static json_t *light_json(const struct sb_light *light, const struct sb_light_struct *row)
{
    json_t *object = json_object();
    for (int i = 0; i < row->field_count; i++) {
        const struct sb_light_field *field = &row->field[i];
        float value[3];
        memcpy(value, (const char *)light + field->offset,
               (size_t)field->components * sizeof *value);
        json_object_set_new(object, field->name,
                            field->components == 1 ? json_real(value[0])
                                                   : numbers(value, field->components));
    }
    return object;
}

static json_t *lights_json(const struct sb_lights *lights, const struct sb_axes *axes)
{
    json_t *object = json_object();
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_struct *row = &sb_light_structs[type];
        int count;
        const struct sb_light *light = sb_lights_of(lights, type, &count);
        json_t *list = json_array();
        for (int i = 0; i < count; i++)
            json_array_append_new(list, light_json(&light[i], row));
        json_object_set_new(object, axes->row[row->axis].name, list);
    }
    return object;
}

static json_t *materials_json(const struct sb_scene *scene)
{
    json_t *list = json_array();
    for (int i = 0; i < scene->material_count; i++) {
        const struct sb_material *material = &scene->material[i];
        json_t *lacks = json_array();
        for (int m = 0; m < SB_MAP_COUNT; m++)
            if (material->lacks >> m & 1)
                json_array_append_new(lacks, json_integer(m));
        json_array_append_new(
            list, json_pack("{so so so sf so}", "ambient", numbers(material->ambient, 3),
                            "diffuse", numbers(material->diffuse, 3), "specular",
                            numbers(material->specular, 3), "shininess",
                            (double)material->shininess, "lacks", lacks));
    }
    return list;
}

static json_t *draws_json(const struct sb_scene *scene)
{
    json_t *list = json_array();
    for (int i = 0; i < scene->draw_count; i++) {
        const struct sb_draw *draw = &scene->draw[i];
        json_array_append_new(list, json_pack("{si si si so so}", "mesh", draw->mesh,
                                              "material", draw->material, "lamp",
                                              draw->lamp, "model",
                                              numbers(draw->model, 16), "normal_matrix",
                                              numbers(draw->normal_matrix, 9)));
    }
    return list;
}

static json_t *values_json(const struct sb_axes *axes, const struct sb_variant *variant)
{
    json_t *object = json_object();
    struct sb_text word = {0};
    for (int i = 0; i < axes->count; i++) {
        sb_text_clear(&word);
        sb_variant_value_text(axes, variant, i, &word);
        json_object_set_new(object, axes->row[i].name, json_string(sb_text_get(&word)));
    }
    sb_text_free(&word);
    return object;
}

static json_t *scene_json(const struct sb_task *task, const struct sb_axes *axes,
                          const struct sb_scene *scene, const struct sb_image *picture)
{
    const struct sb_camera *camera = &scene->camera;
    json_t *meshes = json_array();
    for (int i = 0; i < scene->mesh_count; i++)
        json_array_append_new(meshes, mesh_json(&scene->mesh[i]));
    json_t *camera_json = json_pack("{so so so so}", "eye", numbers(camera->eye, 3),
                                    "view", numbers(camera->view, 16), "projection",
                                    numbers(camera->projection, 16), "view_projection",
                                    numbers(camera->view_projection, 16));
    return json_pack(
        "{ss ss so si si so so so so so so so}", "scene", scene->name, "variant",
        task->entry->id, "values", values_json(axes, &task->assembly.job.variant),
        "width", picture->width, "height", picture->height, "camera", camera_json,
        "ambient", numbers(scene->ambient, 3), "clear_colour",
        numbers(scene->clear_colour, 4), "lights", lights_json(&scene->lights, axes),
        "materials", materials_json(scene), "meshes", meshes, "draws", draws_json(scene));
}

// --- the files ---------------------------------------------------------------------------

static bool write_json(const json_t *json, const char *path, struct sb_error *err)
{
    char *text = json_dumps(json, JSON_COMPACT | JSON_REAL_PRECISION(FLOAT_DIGITS));
    if (!text)
        return sb_fail(err, SB_INTERNAL, "%s: not a JSON value", path);
    const bool good = sb_file_replace(path, text, strlen(text), err);
    free(text);
    return good;
}

static bool write_maps(const struct sb_scene *scene, const char *dir,
                       struct sb_arena *arena, struct sb_error *err)
{
    static const char *const names[SB_MAP_COUNT] = {
        [SB_MAP_DIFFUSE] = "map-diffuse.pfm",
        [SB_MAP_SPECULAR] = "map-specular.pfm",
        [SB_MAP_NORMAL] = "map-normal.pfm",
    };
    bool good = true;
    for (int m = 0; good && m < SB_MAP_COUNT; m++) {
        const struct sb_texture *map = &scene->map[m];
        struct sb_image image = {0};
        if (!map->texel)
            continue;
        sb_image_init(&image, map->width, map->height, 4);
        for (long i = 0; i < 4L * map->width * map->height; i++)
            image.data[i] = (float)map->texel[i] / 255.0f;
        good = sb_image_write_pfm(&image, sb_path_join(arena, dir, names[m]), err);
        sb_image_free(&image);
    }
    return good;
}

static bool write_picture(const struct sb_task *task, const struct sb_driver *driver,
                          enum sb_image_kind kind, const char *path,
                          struct sb_image *image, struct sb_error *err)
{
    const struct sb_image_request request = {
        .job = task->assembly.job.id,
        .kind = kind,
        .wide = kind == SB_IMAGE_COLOUR,
    };
    return driver->fns->image(driver->runner, &request, image, err) &&
           sb_image_write_pfm(image, path, err);
}

bool sb_dump(const struct sb_task *task, const struct sb_driver *driver,
             const struct sb_axes *axes, const char *dir, struct sb_error *err)
{
    struct sb_arena arena = {0};
    struct sb_scene scene = {0};
    struct sb_image colour = {0}, id = {0};
    json_t *json = NULL;
    const char *to = sb_path_join(&arena, dir, sb_task_file_name(task, &arena));
    bool good =
        sb_dir_make(to, err) &&
        write_picture(task, driver, SB_IMAGE_COLOUR,
                      sb_path_join(&arena, to, "colour.pfm"), &colour, err) &&
        write_picture(task, driver, SB_IMAGE_ID, sb_path_join(&arena, to, "id.pfm"), &id,
                      err) &&
        sb_scene_make(task->entry->scene, &task->assembly.job.variant, &scene, err) &&
        write_maps(&scene, to, &arena, err);
    if (good) {
        json = scene_json(task, axes, &scene, &colour);
        good = write_json(json, sb_path_join(&arena, to, "scene.json"), err);
    }
    json_decref(json);
    sb_image_free(&colour);
    sb_image_free(&id);
    sb_scene_free(&scene);
    sb_arena_free(&arena);
    return good;
}
