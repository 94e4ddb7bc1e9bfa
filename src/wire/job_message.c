// A job as a message: its variant and lists in the head, its programs' texts in the payload.
#include <stdlib.h>
#include <string.h>

#include "wire/messages.h"

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))
enum { LIST_MAX = 1 << 20 };

// --- packing ---------------------------------------------------------------------------------

static json_t *variant_json(const struct sb_variant *variant)
{
    json_t *json = json_array();
    for (int a = 0; a < SB_AXIS_MAX; a++)
        json_array_append_new(json, json_real(variant->value[a]));
    return json;
}

static json_t *ints_json(const int *value, int count)
{
    json_t *json = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(json, json_integer(value[i]));
    return json;
}

// The text's length in the head, its bytes behind those before it; null: there is none.
static void put_text(json_t *head, const char *name, const char *text,
                     struct sb_text *payload)
{
    json_object_set_new(head, name,
                        text ? json_integer((json_int_t)strlen(text)) : json_null());
    sb_text_add(payload, text ? text : "");
}

static json_t *programs_json(const struct sb_job *job, struct sb_text *payload)
{
    json_t *programs = json_array();
    for (int i = 0; i < job->program_count; i++) {
        const struct sb_program *program = &job->program[i];
        json_t *json = json_object();
        json_object_set_new(json, "role", sb_text_json(program->role));
        put_text(json, "vertex", program->vertex, payload);
        put_text(json, "geometry", program->geometry, payload);
        put_text(json, "fragment", program->fragment, payload);
        json_array_append_new(programs, json);
    }
    return programs;
}

static json_t *lit_json(const struct sb_job *job)
{
    json_t *all = json_array();
    for (int i = 0; i < job->lit_count; i++) {
        const struct sb_lit *lit = &job->lit[i];
        int lights = 0;
        for (int type = 0; type < SB_JOB_LIGHT_TYPES; type++)
            lights += lit->light_count[type];
        json_t *json = json_object();
        json_object_set_new(json, "program", json_integer(lit->program));
        json_object_set_new(json, "variant", variant_json(&lit->variant));
        json_object_set_new(json, "lights", ints_json(lit->light, lights));
        json_object_set_new(json, "light_counts",
                            ints_json(lit->light_count, SB_JOB_LIGHT_TYPES));
        json_object_set_new(json, "draws", ints_json(lit->draw, lit->draw_count));
        json_array_append_new(all, json);
    }
    return all;
}

static json_t *uniforms_json(const struct sb_job *job)
{
    json_t *all = json_array();
    for (int i = 0; i < job->uniform_count; i++) {
        json_t *json = json_object();
        json_object_set_new(json, "name", sb_text_json(job->uniform[i].name));
        json_object_set_new(json, "values",
                            ints_json(job->uniform[i].value, job->draw_count));
        json_array_append_new(all, json);
    }
    return all;
}

void sb_wire_put_job(const struct sb_job *job, struct sb_frame *frame)
{
    struct sb_text payload = {0};
    json_t *head = frame->head = sb_wire_call("prepare");
    json_object_set_new(head, "id", json_integer(job->id));
    json_object_set_new(head, "variant", variant_json(&job->variant));
    json_object_set_new(head, "scene",
                        job->scene ? sb_text_json(job->scene) : json_null());
    json_object_set_new(head, "programs", programs_json(job, &payload));
    json_object_set_new(head, "lit", lit_json(job));
    json_object_set_new(head, "uniforms", uniforms_json(job));
    json_object_set_new(head, "draw_count", json_integer(job->draw_count));
    frame->payload = (unsigned char *)payload.data;
    frame->size = payload.length;
}

// --- unpacking -------------------------------------------------------------------------------

static bool bad(const char *what, struct sb_error *err)
{
    return sb_fail(err, SB_WORKER_GARBAGE, "wrote a job whose %s is missing or wrong",
                   what);
}

static bool get_variant(const json_t *json, struct sb_variant *variant,
                        struct sb_error *err)
{
    if (json_array_size(json) != SB_AXIS_MAX)
        return bad("variant", err);
    for (int a = 0; a < SB_AXIS_MAX; a++)
        variant->value[a] = json_number_value(json_array_get(json, (size_t)a));
    return true;
}

static bool get_ints(const json_t *json, const int **value, int *count,
                     struct sb_arena *arena, struct sb_error *err)
{
    const size_t size = json_array_size(json);
    if (!json_is_array(json) || size > LIST_MAX)
        return bad("list of numbers", err);
    int *list = sb_arena_alloc(arena, (size + 1) * sizeof *list);
    for (size_t i = 0; i < size; i++)
        list[i] = (int)json_integer_value(json_array_get(json, i));
    *value = list;
    *count = (int)size;
    return true;
}

static const char *get_string(const json_t *json, struct sb_arena *arena)
{
    const char *text = json_string_value(json);
    return text ? sb_arena_strdup(arena, text) : NULL;
}

struct texts { // what is left of the payload
    const unsigned char *at;
    size_t left;
    struct sb_arena *arena;
};

static bool get_text(struct texts *texts, const json_t *length, const char **text,
                     struct sb_error *err)
{
    *text = NULL;
    if (json_is_null(length))
        return true;
    const json_int_t size = json_integer_value(length);
    if (!json_is_integer(length) || size < 0 || (size_t)size > texts->left)
        return bad("program text", err);
    char *copy = sb_arena_alloc(texts->arena, (size_t)size + 1);
    memcpy(copy, texts->at, (size_t)size);
    *text = copy;
    texts->at += size;
    texts->left -= (size_t)size;
    return true;
}

static bool get_programs(const struct sb_frame *frame, struct sb_job *job,
                         struct sb_arena *arena, struct sb_error *err)
{
    const json_t *programs = json_object_get(frame->head, "programs");
    const size_t count = json_array_size(programs);
    struct texts texts = {frame->payload, frame->size, arena};
    struct sb_program *program = sb_arena_alloc(arena, (count + 1) * sizeof *program);
    for (size_t i = 0; i < count; i++) {
        const json_t *json = json_array_get(programs, i);
        program[i].role = get_string(json_object_get(json, "role"), arena);
        if (!program[i].role)
            return bad("program role", err);
        if (!get_text(&texts, json_object_get(json, "vertex"), &program[i].vertex, err) ||
            !get_text(&texts, json_object_get(json, "geometry"), &program[i].geometry,
                      err) ||
            !get_text(&texts, json_object_get(json, "fragment"), &program[i].fragment,
                      err))
            return false;
    }
    job->program = program;
    job->program_count = (int)count;
    return true;
}

static bool get_one_lit(const json_t *json, struct sb_lit *lit, struct sb_arena *arena,
                        struct sb_error *err)
{
    const int *counts;
    int lights, types, sum = 0;
    lit->program = (int)json_integer_value(json_object_get(json, "program"));
    if (!get_variant(json_object_get(json, "variant"), &lit->variant, err) ||
        !get_ints(json_object_get(json, "lights"), &lit->light, &lights, arena, err) ||
        !get_ints(json_object_get(json, "light_counts"), &counts, &types, arena, err) ||
        !get_ints(json_object_get(json, "draws"), &lit->draw, &lit->draw_count, arena,
                  err))
        return false;
    for (int type = 0; type < SB_JOB_LIGHT_TYPES && type < types; type++)
        sum += lit->light_count[type] = counts[type];
    return (types == SB_JOB_LIGHT_TYPES && sum == lights) || bad("list of lights", err);
}

static bool get_lit(const json_t *all, struct sb_job *job, struct sb_arena *arena,
                    struct sb_error *err)
{
    const size_t count = json_array_size(all);
    struct sb_lit *lit = sb_arena_alloc(arena, (count + 1) * sizeof *lit);
    for (size_t i = 0; i < count; i++)
        if (!get_one_lit(json_array_get(all, i), &lit[i], arena, err))
            return false;
    job->lit = lit;
    job->lit_count = (int)count;
    return true;
}

static bool get_uniforms(const json_t *all, struct sb_job *job, struct sb_arena *arena,
                         struct sb_error *err)
{
    const size_t count = json_array_size(all);
    struct sb_job_uniform *uniform = sb_arena_alloc(arena, (count + 1) * sizeof *uniform);
    for (size_t i = 0; i < count; i++) {
        const json_t *json = json_array_get(all, i);
        int values;
        uniform[i].name = get_string(json_object_get(json, "name"), arena);
        if (!get_ints(json_object_get(json, "values"), &uniform[i].value, &values, arena,
                      err))
            return false;
        if (!uniform[i].name || values != job->draw_count)
            return bad("uniform", err);
    }
    job->uniform = uniform;
    job->uniform_count = (int)count;
    return true;
}

bool sb_wire_get_job(const struct sb_frame *frame, struct sb_job *job,
                     struct sb_arena *arena, struct sb_error *err)
{
    const json_t *head = frame->head;
    *job = (struct sb_job){
        .id = (uint32_t)json_integer_value(json_object_get(head, "id")),
        .scene = get_string(json_object_get(head, "scene"), arena),
        .draw_count = (int)json_integer_value(json_object_get(head, "draw_count")),
    };
    return get_variant(json_object_get(head, "variant"), &job->variant, err) &&
           get_programs(frame, job, arena, err) &&
           get_lit(json_object_get(head, "lit"), job, arena, err) &&
           get_uniforms(json_object_get(head, "uniforms"), job, arena, err);
}
