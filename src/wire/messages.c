#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "wire/messages.h"

enum { SHOTS_MAX = 1 << 16, IMAGE_SIDE_MAX = 1 << 16 };
#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

uint64_t sb_wire_axes_hash(void)
{
    const struct sb_axes *axes = sb_axes_builtin();
    uint64_t hash = SB_HASH_START;
    for (int a = 0; a < axes->count; a++) {
        const struct sb_axis *axis = &axes->row[a];
        hash = sb_hash(hash, axis->name, strlen(axis->name) + 1);
        for (int v = 0; v < axis->value_count; v++)
            hash = sb_hash(hash, axis->values[v].name, strlen(axis->values[v].name) + 1);
    }
    return hash;
}

json_t *sb_wire_call(const char *call)
{
    json_t *head = json_object();
    json_object_set_new(head, "call", json_string(call));
    return head;
}

// --- open ------------------------------------------------------------------------------------

#define CONTEXT(member) SB_FIELD(struct sb_context_params, member)
static const struct sb_field open_fields[] = {CONTEXT(context), CONTEXT(gles),
                                              CONTEXT(device), CONTEXT(driver_stats),
                                              CONTEXT(count)};
#undef CONTEXT

void sb_wire_put_open(json_t *head, const struct sb_context_params *params)
{
    char hash[32];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)sb_wire_axes_hash());
    json_object_set_new(head, "version", json_integer(SB_WIRE_VERSION));
    json_object_set_new(head, "axes", json_string(hash));
    json_object_set_new(head, "params",
                        sb_fields_pack(open_fields, COUNT(open_fields), params));
    if (params->program_cache)
        json_object_set_new(head, "program_cache", sb_text_json(params->program_cache));
    if (params->count_folder)
        json_object_set_new(head, "count_folder", sb_text_json(params->count_folder));
    json_t *environment = json_array();
    for (int i = 0; i < params->environment_count; i++)
        json_array_append_new(environment, sb_text_json(params->environment[i]));
    json_object_set_new(head, "environment", environment);
}

static bool check_version(const json_t *head, struct sb_error *err)
{
    char hash[32];
    const char *theirs = json_string_value(json_object_get(head, "axes"));
    const json_int_t version = json_integer_value(json_object_get(head, "version"));
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)sb_wire_axes_hash());
    if (version != SB_WIRE_VERSION)
        return sb_fail(err, SB_BAD_INPUT,
                       "shadebench speaks version %lld of the worker protocol, this "
                       "worker version %d: install one version on both sides",
                       (long long)version, SB_WIRE_VERSION);
    if (!theirs || strcmp(theirs, hash) != 0)
        return sb_fail(err, SB_BAD_INPUT,
                       "shadebench and this worker (version %s) have different axes: "
                       "install one version on both sides",
                       SB_VERSION);
    return true;
}

bool sb_wire_get_open(const json_t *head, struct sb_context_params *params,
                      struct sb_arena *arena, struct sb_error *err)
{
    const char *cache = json_string_value(json_object_get(head, "program_cache"));
    const char *folder = json_string_value(json_object_get(head, "count_folder"));
    const json_t *environment = json_object_get(head, "environment");
    if (!check_version(head, err) ||
        !sb_fields_unpack(open_fields, COUNT(open_fields),
                          json_object_get(head, "params"), params, arena, err))
        return false;
    params->program_cache = cache ? sb_arena_strdup(arena, cache) : NULL;
    params->count_folder = folder ? sb_arena_strdup(arena, folder) : NULL;
    const size_t count = json_array_size(environment);
    const char **setting = sb_arena_alloc(arena, (count + 1) * sizeof *setting);
    for (size_t i = 0; i < count; i++) {
        const char *text = json_string_value(json_array_get(environment, i));
        setting[i] = sb_arena_strdup(arena, text ? text : "");
    }
    params->environment = setting;
    params->environment_count = (int)count;
    return true;
}

// --- round -----------------------------------------------------------------------------------

#define SHOT(member) SB_FIELD(struct sb_shot, member)
static const struct sb_field shot_fields[] = {SHOT(job), SHOT(frames), SHOT(shrink),
                                              SHOT(part)};
#undef SHOT
#define SAMPLE(member) SB_FIELD(struct sb_sample, member)
static const struct sb_field sample_fields[] = {
    SAMPLE(job),    SAMPLE(frames),    SAMPLE(gpu_ns),       SAMPLE(wall_ns),
    SAMPLE(cpu_ns), SAMPLE(submit_ns), SAMPLE(instructions), SAMPLE(flags),
};
#undef SAMPLE

json_t *sb_wire_pack_shots(const struct sb_shot *shots, int count)
{
    return sb_fields_pack_all(shot_fields, COUNT(shot_fields), shots, count,
                              sizeof *shots);
}

bool sb_wire_get_shots(const json_t *json, struct sb_shot *shots, int limit, int *count,
                       struct sb_error *err)
{
    return sb_fields_unpack_all(shot_fields, COUNT(shot_fields), json, shots, limit,
                                sizeof *shots, count, NULL, err);
}

json_t *sb_wire_pack_sample(const struct sb_sample *sample)
{
    return sb_fields_pack(sample_fields, COUNT(sample_fields), sample);
}

bool sb_wire_get_sample(const json_t *json, struct sb_sample *sample,
                        struct sb_error *err)
{
    return sb_fields_unpack(sample_fields, COUNT(sample_fields), json, sample, NULL, err);
}

// --- images ----------------------------------------------------------------------------------

#define IMAGE(member) SB_FIELD(struct sb_image, member)
static const struct sb_field image_fields[] = {IMAGE(width), IMAGE(height),
                                               IMAGE(channels)};
#undef IMAGE
#define REQUEST(member) SB_FIELD(struct sb_image_request, member)
static const struct sb_field request_fields[] = {
    REQUEST(job),    REQUEST(kind),        REQUEST(page),      REQUEST(light),
    REQUEST(adding), REQUEST(inputs_only), REQUEST(one_pixel), REQUEST(x),
    REQUEST(y),      REQUEST(caster),      REQUEST(width),     REQUEST(height),
    REQUEST(wide),   REQUEST(single),      REQUEST(off_first), REQUEST(off_count),
};
#undef REQUEST

static size_t image_length(const struct sb_image *image)
{
    return (size_t)image->width * (size_t)image->height * (size_t)image->channels;
}

// Little-endian, whatever the machine.
static void put_floats(const float *from, size_t count, struct sb_frame *frame)
{
    frame->size = count * 4;
    frame->payload = sb_alloc(frame->size + 1);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &from[i], sizeof bits);
        for (int b = 0; b < 4; b++)
            frame->payload[4 * i + (size_t)b] = (unsigned char)(bits >> (8 * b));
    }
}

static void get_floats(const unsigned char *from, size_t count, float *to)
{
    for (size_t i = 0; i < count; i++) {
        const unsigned char *byte = from + 4 * i;
        const uint32_t bits = byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 |
                              (uint32_t)byte[3] << 24;
        memcpy(&to[i], &bits, sizeof bits);
    }
}

static bool get_pixels(const json_t *shape, const struct sb_frame *frame,
                       struct sb_image *image, struct sb_error *err)
{
    struct sb_image told = {0};
    if (!sb_fields_unpack(image_fields, COUNT(image_fields), shape, &told, NULL, err))
        return false;
    if (told.width < 1 || told.height < 1 || told.channels < 1 ||
        told.width > IMAGE_SIDE_MAX || told.height > IMAGE_SIDE_MAX ||
        told.channels > 16 || image_length(&told) * 4 != frame->size)
        return sb_fail(err, SB_WORKER_GARBAGE,
                       "wrote an image of %d x %d x %d in %zu bytes", told.width,
                       told.height, told.channels, frame->size);
    sb_image_init(image, told.width, told.height, told.channels);
    get_floats(frame->payload, image_length(image), image->data);
    return true;
}

void sb_wire_put_image(const struct sb_image *image, struct sb_frame *frame)
{
    json_object_set_new(frame->head, "image",
                        sb_fields_pack(image_fields, COUNT(image_fields), image));
    put_floats(image->data, image_length(image), frame);
}

bool sb_wire_get_image(const struct sb_frame *frame, struct sb_image *image,
                       struct sb_error *err)
{
    return get_pixels(json_object_get(frame->head, "image"), frame, image, err);
}

void sb_wire_put_request(const struct sb_image_request *request, struct sb_frame *frame)
{
    frame->head = sb_wire_call("image");
    json_object_set_new(frame->head, "request",
                        sb_fields_pack(request_fields, COUNT(request_fields), request));
    if (!request->rows)
        return;
    json_object_set_new(frame->head, "rows",
                        sb_fields_pack(image_fields, COUNT(image_fields), request->rows));
    put_floats(request->rows->data, image_length(request->rows), frame);
}

bool sb_wire_get_request(const struct sb_frame *frame, struct sb_image_request *request,
                         struct sb_image *rows, struct sb_error *err)
{
    const json_t *shape = json_object_get(frame->head, "rows");
    *request = (struct sb_image_request){0};
    if (!sb_fields_unpack(request_fields, COUNT(request_fields),
                          json_object_get(frame->head, "request"), request, NULL, err))
        return false;
    if (!shape)
        return true;
    request->rows = rows;
    return get_pixels(shape, frame, rows, err);
}

// --- answers ---------------------------------------------------------------------------------

json_t *sb_wire_pack_error(const struct sb_error *err)
{
    json_t *json = json_object();
    json_object_set_new(json, "status", json_string(sb_status_rows[err->status].word));
    json_object_set_new(json, "text", sb_text_json(err->text));
    return json;
}

bool sb_wire_get_error(const json_t *json, struct sb_error *told, struct sb_error *err)
{
    const char *word = json_string_value(json_object_get(json, "status"));
    const char *text = json_string_value(json_object_get(json, "text"));
    const enum sb_status status = word ? sb_status_find(word) : SB_STATUS_COUNT;
    if (status == SB_STATUS_COUNT || !text)
        return sb_fail(err, SB_WORKER_GARBAGE, "wrote an error of no known status");
    *told = (struct sb_error){.status = status};
    snprintf(told->text, sizeof told->text, "%s", text);
    return true;
}

static const struct sb_field caps_fields[] = {
    SB_FIELD(struct sb_caps, context),
#define CAP_TEXT(name, help)   SB_FIELD(struct sb_caps, name),
#define CAP_NUMBER(name, help) SB_FIELD(struct sb_caps, name),
#include "job/caps.def"
#undef CAP_TEXT
#undef CAP_NUMBER
};

json_t *sb_wire_pack_caps(const struct sb_caps *caps)
{
    return sb_fields_pack(caps_fields, COUNT(caps_fields), caps);
}

bool sb_wire_get_caps(const json_t *json, struct sb_caps *caps, struct sb_error *err)
{
    return sb_fields_unpack(caps_fields, COUNT(caps_fields), json, caps, NULL, err);
}

#define SOURCE(member) SB_FIELD(struct sb_timer_source, member)
static const struct sb_field source_fields[] = {
    SOURCE(name), SOURCE(usable), SOURCE(bits), SOURCE(granularity_ns), SOURCE(empty_ns),
};
#undef SOURCE
#define READING(member) SB_FIELD(struct sb_timer_reading, member)
static const struct sb_field reading_fields[] = {
    READING(source),   READING(load),        READING(size),     READING(frames),
    READING(query_ns), READING(wall_ns),     READING(wait_ns),  READING(drained_ns),
    READING(samples),  READING(samples_one), READING(disjoint),
};
#undef READING

json_t *sb_wire_pack_audit(const struct sb_audit *audit)
{
    json_t *json = json_object();
    json_object_set_new(json, "sources",
                        sb_fields_pack_all(source_fields, COUNT(source_fields),
                                           audit->source, audit->source_count,
                                           sizeof *audit->source));
    json_object_set_new(json, "readings",
                        sb_fields_pack_all(reading_fields, COUNT(reading_fields),
                                           audit->reading, audit->reading_count,
                                           sizeof *audit->reading));
    return json;
}

bool sb_wire_get_audit(const json_t *json, struct sb_audit *audit, struct sb_arena *arena,
                       struct sb_error *err)
{
    *audit = (struct sb_audit){0};
    return sb_fields_unpack_all(source_fields, COUNT(source_fields),
                                json_object_get(json, "sources"), audit->source,
                                SB_TIMER_MAX, sizeof *audit->source, &audit->source_count,
                                arena, err) &&
           sb_fields_unpack_all(reading_fields, COUNT(reading_fields),
                                json_object_get(json, "readings"), audit->reading,
                                SB_READING_MAX, sizeof *audit->reading,
                                &audit->reading_count, NULL, err);
}

#define PRECISION(member) SB_FIELD(struct sb_precision_reading, member)
static const struct sb_field precision_fields[] = {
    PRECISION(vertex_stage), PRECISION(carrier),   PRECISION(precision), PRECISION(add),
    PRECISION(square),       PRECISION(tiny),      PRECISION(round),     PRECISION(lone),
    PRECISION(nan_left),     PRECISION(nan_right), PRECISION(pow_zero),  PRECISION(used),
};
#undef PRECISION

json_t *sb_wire_pack_probe(const struct sb_probe *probe)
{
    json_t *json = json_object();
    json_object_set_new(json, "readings",
                        sb_fields_pack_all(precision_fields, COUNT(precision_fields),
                                           probe->reading, probe->count,
                                           sizeof *probe->reading));
    json_object_set_new(json, "nesting", json_integer(probe->nesting));
    return json;
}

bool sb_wire_get_probe(const json_t *json, struct sb_probe *probe, struct sb_error *err)
{
    *probe = (struct sb_probe){0};
    probe->nesting = (int)json_integer_value(json_object_get(json, "nesting"));
    return sb_fields_unpack_all(precision_fields, COUNT(precision_fields),
                                json_object_get(json, "readings"), probe->reading,
                                SB_PRECISION_MAX, sizeof *probe->reading, &probe->count,
                                NULL, err);
}

#define PREPARED(member) SB_FIELD(struct sb_prepared, member)
static const struct sb_field prepared_fields[] = {
    PREPARED(failed_program), PREPARED(failed_stage),    PREPARED(compile_ms),
    PREPARED(link_ms),        PREPARED(first_draw_ms),   PREPARED(vertices),
    PREPARED(fragments),      PREPARED(gl_calls),        PREPARED(programs),
    PREPARED(switches),       PREPARED(programs_cached), PREPARED(casters),
    PREPARED(draws_shadows),  PREPARED(input_hash),      PREPARED(binary_hash),
    PREPARED(driver_stats),
};
#undef PREPARED

void sb_wire_put_prepared(const struct sb_prepared *prepared, struct sb_frame *frame)
{
    json_object_set_new(
        frame->head, "prepared",
        sb_fields_pack(prepared_fields, COUNT(prepared_fields), prepared));
    json_object_set_new(frame->head, "error", sb_wire_pack_error(&prepared->error));
    if (!prepared->log)
        return;
    frame->size = strlen(prepared->log);
    frame->payload = (unsigned char *)sb_strdup(prepared->log);
}

bool sb_wire_get_prepared(const struct sb_frame *frame, struct sb_prepared *prepared,
                          struct sb_error *err)
{
    *prepared = (struct sb_prepared){0};
    if (!sb_fields_unpack(prepared_fields, COUNT(prepared_fields),
                          json_object_get(frame->head, "prepared"), prepared, NULL,
                          err) ||
        !sb_wire_get_error(json_object_get(frame->head, "error"), &prepared->error, err))
        return false;
    if (frame->size > 0) {
        prepared->log = sb_alloc(frame->size + 1);
        memcpy(prepared->log, frame->payload, frame->size);
    }
    return true;
}
