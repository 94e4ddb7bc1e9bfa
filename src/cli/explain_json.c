#include "cli/explain_json.h"

#include <math.h>

#include "base/text.h"
#include "reference/share.h"

// JSON has no NaN and no infinity: they become words.
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value)
                           : json_string(isnan(value) ? "nan"
                                         : value < 0  ? "-inf"
                                                      : "inf");
}

static json_t *floats(const float *value, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, number(value[i]));
    return list;
}

static json_t *doubles(const double *value, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, number(value[i]));
    return list;
}

static json_t *vector(struct sb_vec3 v)
{
    return doubles((double[3]){v.x, v.y, v.z}, 3);
}

static json_t *triangle(const struct sb_explanation *explanation)
{
    const struct sb_ref_cover at = {explanation->draw, explanation->triangle};
    int corner[3];
    sb_ref_geometry_corners(explanation->truth.ground->geometry, at, corner);
    return json_pack("{si si s[iii] so so}", "draw", explanation->draw, "triangle",
                     explanation->triangle, "vertices", corner[0], corner[1], corner[2],
                     "weights", doubles(explanation->weight, 3), "driver_weights",
                     floats(explanation->driver_weight, 3));
}

static json_t *material(const struct sb_material *it)
{
    return json_pack("{so so so so}", "ambient", floats(it->ambient, 3), "diffuse",
                     floats(it->diffuse, 3), "specular", floats(it->specular, 3),
                     "shininess", number(it->shininess));
}

// --- a light -----------------------------------------------------------------------------

// The members that the variant's shaders have, as they were uploaded.
static json_t *uploaded(const struct sb_explained_light *light,
                        const struct sb_variant *variant)
{
    struct sb_light_members members;
    json_t *object = json_object();
    sb_light_members_of(&sb_light_structs[sb_light_struct_of(variant, light->type)],
                        variant, &members);
    for (int i = 0; i < members.count; i++) {
        const struct sb_light_field *field = members.field[i];
        const float *value = (const float *)((const char *)&light->light + field->offset);
        json_object_set_new(object, field->name,
                            field->components == 1 ? number(*value)
                                                   : floats(value, field->components));
    }
    return object;
}

static json_t *term(const struct sb_explanation *explanation,
                    const struct sb_explained_light *light, enum sb_term which)
{
    const struct sb_term_row *row = &sb_term_rows[which];
    const double *reference =
        (const double *)((const char *)light->reference + row->offset);
    return json_pack("{so so so si}", "reference", doubles(reference, row->components),
                     "driver", floats(&light->driver[row->place], row->components),
                     "ulps", number(light->ulps[which]), "bits",
                     explanation->bits[which]);
}

static json_t *light_json(const struct sb_explanation *explanation,
                          const struct sb_explained_light *light,
                          const struct sb_variant *variant)
{
    struct sb_text name = {0};
    json_t *terms = json_object();
    for (int t = 0; t < SB_TERM_COUNT; t++)
        json_object_set_new(terms, sb_term_rows[t].name,
                            term(explanation, light, (enum sb_term)t));
    sb_text_printf(&name, "%s %d", sb_light_structs[light->type].name, light->number);
    json_t *object =
        json_pack("{ss so so so ss*}", "name", sb_text_get(&name), "as_uploaded",
                  uploaded(light, variant), "visited",
                  json_boolean(light->driver[11] == 1), "terms", terms, "went_wrong",
                  light->wrong >= 0 ? sb_term_rows[light->wrong].name : NULL);
    sb_text_free(&name);
    return object;
}

// --- where it is lit -----------------------------------------------------------------------

// The maps that the variant reads. `told`: as the driver sampled them; NULL: as they are at uv.
static json_t *maps(const struct sb_explanation *explanation,
                    const struct sb_variant *variant, const float *told,
                    const double uv[2])
{
    static const char *const names[SB_MAP_COUNT] = {
        [SB_MAP_DIFFUSE] = "diffuse",
        [SB_MAP_SPECULAR] = "specular",
        [SB_MAP_NORMAL] = "normal",
    };
    json_t *object = json_object();
    for (int m = 0; m < SB_MAP_COUNT; m++) {
        const struct sb_texture *map = &explanation->truth.scene->map[m];
        if (sb_ref_needs_map(variant, (enum sb_map)m))
            json_object_set_new(object, names[m],
                                told ? floats(told + 3 * m, 3)
                                     : vector(sb_ref_texture(map, uv)));
    }
    return object;
}

static void add_maps(json_t *object, const struct sb_explanation *explanation,
                     const struct sb_variant *variant, const float *told,
                     const double uv[2])
{
    if (told)
        json_object_set_new(object, "maps", maps(explanation, variant, told, uv));
    json_object_set_new(object, "maps_exact", maps(explanation, variant, NULL, uv));
}

static json_t *inputs(const struct sb_explained_point *point,
                      const struct sb_variant *variant)
{
    const struct sb_ref_input *input = &point->reference.input;
    json_t *object =
        json_pack("{so so so}", "position", vector(input->position), "normal",
                  vector(input->normal), "uv", doubles(input->uv, 2));
    if (point->vertex < 0 && sb_ref_needs_frame(variant)) {
        json_object_set_new(object, "tangent", vector(input->tangent));
        json_object_set_new(object, "bitangent", vector(input->bitangent));
    }
    return object;
}

static json_t *point_json(const struct sb_explanation *explanation, int number_of_point,
                          const struct sb_variant *variant)
{
    const struct sb_explained_point *point = &explanation->point[number_of_point];
    const struct sb_ref_shade *shade = &point->reference.shade;
    json_t *lights = json_array();
    for (int i = 0; i < explanation->light_count; i++)
        json_array_append_new(lights, light_json(explanation, &point->light[i], variant));
    json_t *object = json_object();
    if (point->vertex >= 0)
        json_object_set_new(object, "vertex", json_integer(point->vertex));
    json_object_set_new(object, "inputs", inputs(point, variant));
    if (explanation->has_maps) // a corner has none that a driver sampled
        add_maps(object, explanation, variant,
                 point->vertex < 0 ? explanation->maps : NULL, point->reference.input.uv);
    json_object_set_new(object, "view_vector",
                        json_pack("{so so}", "reference", vector(shade->view), "driver",
                                  floats(&point->frame[6], 3)));
    json_object_set_new(object, "normal_as_lit",
                        json_pack("{so so}", "reference", vector(shade->normal), "driver",
                                  floats(&point->frame[9], 3)));
    json_object_set_new(object, "light", lights);
    json_object_set_new(object, "leaves",
                        json_pack("{so so so}", "diffuse", vector(shade->diffuse),
                                  "specular", vector(shade->specular), "colour",
                                  vector(point->reference.colour)));
    if (point->vertex >= 0)
        json_object_set_new(object, "driver_leaves",
                            json_pack("{so so}", "diffuse", floats(point->diffuse, 3),
                                      "specular", floats(point->specular, 3)));
    return object;
}

static json_t *probe(const struct sb_explanation *explanation)
{
    if (explanation->probe_off == 0)
        return json_string("same colour");
    struct sb_text text = {0};
    sb_text_printf(&text, "another colour by %.3g", explanation->probe_off);
    json_t *word = json_string(sb_text_get(&text));
    sb_text_free(&text);
    return word;
}

static json_t *verdict(const struct sb_explanation *explanation)
{
    if (explanation->probe_off > 0)
        return json_string("not known: the program that tells draws another colour here");
    if (explanation->wrong_term < 0)
        return json_null();
    const struct sb_explained_light *light =
        &explanation->point[explanation->wrong_point].light[explanation->wrong_light];
    struct sb_text text = {0};
    sb_text_printf(&text, "%s of %s %d, %.3g ulps", sb_term_rows[light->wrong].name,
                   sb_light_structs[light->type].name, light->number,
                   light->ulps[light->wrong]);
    json_t *word = json_string(sb_text_get(&text));
    sb_text_free(&text);
    return word;
}

static json_t *differences(const struct sb_explanation *explanation)
{
    double part[4][3];
    for (int c = 0; c < 3; c++) {
        part[0][c] = explanation->model[c] - explanation->ideal[c];
        part[1][c] = explanation->given[c] - explanation->model[c];
        part[2][c] = explanation->wide[c] - explanation->given[c];
        part[3][c] = (double)explanation->own[c] - explanation->wide[c];
    }
    return json_pack("{so so so so}", "formulation", doubles(part[0], 3), "interpolation",
                     doubles(part[1], 3), "arithmetic", doubles(part[2], 3),
                     "quantisation", doubles(part[3], 3));
}

json_t *sb_explanation_json(const struct sb_explanation *explanation,
                            const struct sb_task *task, const struct sb_driver *driver)
{
    const struct sb_variant *variant = &task->assembly.job.variant;
    const struct sb_scene *scene = explanation->truth.scene;
    json_t *object = json_pack("{ss ss ss s[ii] s[ii]}", "scene", scene->name, "variant",
                               task->entry->id, "renderer", driver->caps.renderer,
                               "pixel", explanation->x, explanation->y, "size",
                               explanation->width, explanation->height);
    if (explanation->draw < 0) {
        json_object_set_new(object, "shows", json_string("the background"));
    } else if (explanation->point_count == 0) {
        json_object_set_new(object, "shows", json_string("a lamp, which is not lit"));
    } else {
        json_t *points = json_array();
        json_object_set_new(object, "shows", triangle(explanation));
        json_object_set_new(object, "probe", probe(explanation));
        json_object_set_new(object, "eye", vector(explanation->point[0].reference.eye));
        json_object_set_new(object, "scene_ambient", floats(scene->ambient, 3));
        json_object_set_new(object, "material", material(explanation->material));
        if (explanation->has_maps && explanation->point_count > 1)
            add_maps(object, explanation, variant, explanation->maps,
                     explanation->exact.uv);
        for (int i = 0; i < explanation->point_count; i++)
            json_array_append_new(points, point_json(explanation, i, variant));
        json_object_set_new(object, explanation->point_count == 1 ? "fragment" : "corner",
                            points);
        json_object_set_new(object, "first_wrong", verdict(explanation));
    }
    json_object_set_new(object, "ideal", doubles(explanation->ideal, 3));
    json_object_set_new(object, "model", doubles(explanation->model, 3));
    json_object_set_new(object, "given", doubles(explanation->given, 3));
    json_object_set_new(object, "driver", floats(explanation->wide, 3));
    json_object_set_new(object, "displayed", floats(explanation->own, 3));
    json_object_set_new(object, "differences", differences(explanation));
    return object;
}
