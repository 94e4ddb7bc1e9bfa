#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "job/null.h"

struct null_runner {
    struct sb_null_script script;
    struct sb_job *job; // by order of prepare; .program is not kept
    int job_count, job_capacity;
    int64_t shots, rounds;
    uint64_t noise;
    bool counts;
};

struct sb_null_script *sb_null_script(void *runner)
{
    return &((struct null_runner *)runner)->script;
}

static void *null_open(const struct sb_context_params *params, struct sb_caps *caps,
                       struct sb_error *err)
{
    (void)err;
    *caps = (struct sb_caps){
        .context = "null",
        .vendor = "shadebench",
        .renderer = "null (scripted, nothing is drawn)",
        .version = "none",
        .glsl_version = "none",
        .software = params->count, // what is counted is the work of a CPU
        .gles = params->gles,
        .api_version = params->gles ? 320 : 460,
        .glsl = params->gles ? 320 : 460,
        .vertex_uniform_components = 16384,
        .fragment_uniform_components = 16384,
        .uniform_block_size = 65536,
        .varying_components = 128,
        .texture_units = 32,
        .combined_texture_units = 192,
        .texture_size = 16384,
        .cube_map_size = 16384,
        .array_layers = 2048,
        .renderbuffer_size = 16384,
        .samples = 8,
        .colour_float = 1,
        .colour_half = 1,
        .elapsed_bits = 64,
        .timestamp_bits = 64,
        .samples_passed = !params->gles,
        .geometry_shader = 1,
        .cube_map_array = 1,
    };
    struct null_runner *null = sb_alloc(sizeof *null);
    null->noise = 1;
    null->counts = params->count;
    snprintf(caps->counter, sizeof caps->counter, "%s", params->count ? "made up" : "");
    return null;
}

static void note(struct null_runner *null, const char *call, int64_t number)
{
    if (null->script.log)
        sb_text_printf(null->script.log, "%s %lld\n", call, (long long)number);
}

static bool null_audit(void *self, struct sb_audit *audit, struct sb_error *err)
{
    (void)err;
    struct null_runner *null = self;
    note(null, "audit", 0);
    memset(audit, 0, sizeof *audit);
    audit->source[0] = (struct sb_timer_source){.name = "scripted",
                                                .usable = true,
                                                .bits = 64,
                                                .granularity_ns = 1,
                                                .empty_ns = 10};
    audit->source_count = 1;
    const double truth = null->script.no_credible_timer ? 0.05 : 1;
    for (int load = 0; load < SB_LOAD_COUNT; load++)
        for (int size = 64; size <= 512; size *= 2)
            for (int frames = 1; frames <= 8; frames *= 2)
                for (int repeat = 0; repeat < 3; repeat++) {
                    const int64_t ns = 2500000 * (int64_t)frames;
                    audit->reading[audit->reading_count++] = (struct sb_timer_reading){
                        .load = (enum sb_load)load,
                        .size = size,
                        .frames = frames,
                        .query_ns = (int64_t)(truth * (double)ns),
                        .wall_ns = ns,
                        .drained_ns = ns,
                        .samples = -1,
                        .samples_one = -1,
                    };
                }
    return true;
}

static bool null_use_timer(void *self, int source, struct sb_error *err)
{
    (void)err;
    note(self, "use_timer", source);
    return true;
}

static bool null_probe(void *self, struct sb_probe *probe, struct sb_error *err)
{
    (void)err;
    note(self, "probe", 0);
    *probe = (struct sb_probe){.nesting = SB_NESTING_ASKED};
    probe->count = sb_precision_questions(probe->reading);
    for (int i = 0; i < probe->count; i++) {
        struct sb_precision_reading *reading = &probe->reading[i];
        reading->add = 2050;
        reading->square = 256;
        reading->tiny = 1;
        reading->round = 1.5f / 2048;
    }
    return true;
}

static struct sb_job *find_job(struct null_runner *null, uint32_t id)
{
    for (int i = 0; i < null->job_count; i++)
        if (null->job[i].id == id)
            return &null->job[i];
    return NULL;
}

static bool null_prepare(void *self, const struct sb_job *job,
                         struct sb_prepared *prepared)
{
    struct null_runner *null = self;
    note(null, "prepare", job->id);
    *prepared = (struct sb_prepared){
        .compile_ms = 1,
        .link_ms = 2,
        .first_draw_ms = 3,
        .vertices = 6000,
        .fragments = 40000,
        .gl_calls = 25,
    };
    if (job->scene)
        prepared->input_hash = sb_hash(SB_HASH_START, job->scene, strlen(job->scene));
    if (null->script.prepare)
        null->script.prepare(null->script.user, job, prepared);
    if (prepared->error.status != SB_OK)
        return false;
    null->job =
        sb_grow(null->job, null->job_count, &null->job_capacity, sizeof *null->job);
    null->job[null->job_count] = *job;
    null->job[null->job_count++].program = NULL;
    return true;
}

// Uniform in [-1, 1): the noise of made-up times only, so a linear congruence will do
// (Knuth, TAOCP vol. 2, 3.3.4, line 26).
static double noise(struct null_runner *null)
{
    null->noise = null->noise * UINT64_C(6364136223846793005) + 1442695040888963407u;
    return (double)(int64_t)null->noise / 9223372036854775808.0;
}

// The null runner names no axis, so any axis that is a count costs: the sum of all numbers
// of the scene axes, each weighted by its place, makes variants differ. A way of doing it that stands
// before the default in its list takes less, one behind it more.
static double made_up_cost(const struct sb_job *job)
{
    double cost = 2e5;
    const struct sb_axes *axes = sb_axes_builtin();
    for (int i = 0; i < axes->count; i++)
        if (axes->row[i].kind == SB_SCENE && !axes->row[i].values &&
            axes->row[i].max <= 256)
            cost += 1e4 * (1 + i % 3) * job->variant.value[i];
    for (int i = 0; i < axes->count; i++)
        if (axes->row[i].kind == SB_IMPLEMENTATION && axes->row[i].values &&
            job->variant.value[i] != axes->row[i].init)
            cost *= job->variant.value[i] < axes->row[i].init ? 0.6 : 1.6;
    return cost;
}

static double made_up_ns(struct null_runner *null, const struct sb_job *job)
{
    return made_up_cost(job) * (1 + 0.02 * noise(null));
}

// As often as it is asked the same.
static int64_t count_instructions(const struct null_runner *null,
                                  const struct sb_job *job, const struct sb_shot *shot)
{
    const struct sb_null_script *script = &null->script;
    if (!null->counts)
        return SB_NO_TIME;
    return script->instructions
               ? script->instructions(script->user, job, shot, null->shots)
               : (int64_t)(3 * made_up_cost(job)) * shot->frames;
}

static bool null_round(void *self, const struct sb_shot *shots, int count,
                       struct sb_sample *samples, struct sb_error *err)
{
    struct null_runner *null = self;
    const struct sb_null_script *script = &null->script;
    note(null, "round", null->rounds);
    if (script->round_fails && script->round_fails(script->user, null->rounds))
        return sb_fail(err, SB_GL_ERROR, "scripted failure in round %lld",
                       (long long)null->rounds);
    null->rounds++;
    for (int i = 0; i < count; i++) {
        const struct sb_job *job = find_job(null, shots[i].job);
        if (!job)
            return sb_fail(err, SB_INTERNAL, "no job %u", shots[i].job);
        note(null, " shot", shots[i].job);
        double ns = script->frame_ns
                        ? script->frame_ns(script->user, job, &shots[i], null->shots)
                        : made_up_ns(null, job);
        ns *= (double)shots[i].frames / (shots[i].shrink * shots[i].shrink);
        if (shots[i].part == SB_PART_SHADOWS)
            ns *= script->shadow_share;
        const double wall = script->wall_over_gpu ? script->wall_over_gpu : 1;
        samples[i] = (struct sb_sample){
            .job = shots[i].job,
            .frames = shots[i].frames,
            .gpu_ns = (int64_t)ns,
            .wall_ns = (int64_t)(ns * wall),
            .cpu_ns = (int64_t)(ns * 0.1),
            .submit_ns = (int64_t)(ns * 0.05),
            .instructions = count_instructions(null, job, &shots[i]),
            .flags =
                script->flags ? script->flags(script->user, &shots[i], null->shots) : 0,
        };
        null->shots++;
    }
    return true;
}

// An unfolded cube: the middle row of four faces, and one above and below the second.
static void draw_cross(struct sb_image *image, float stored)
{
    enum { FACE = 8 };
    sb_image_init(image, 4 * FACE, 3 * FACE, 1);
    for (int y = 0; y < 3 * FACE; y++)
        for (int x = 0; x < 4 * FACE; x++)
            if (y / FACE == 1 || x / FACE == 1)
                *sb_image_at(image, x, y) = stored * (float)(1 + x) / (4 * FACE);
}

// One draw of one triangle over everything, and a probe that has nothing to tell.
static void draw_kind(struct sb_image *image, const struct sb_image_request *request,
                      int side, float colour)
{
    static const int channels[] = {
        [SB_IMAGE_COLOUR] = 4,   [SB_IMAGE_ID] = 1,     [SB_IMAGE_SHADOW] = 1,
        [SB_IMAGE_GEOMETRY] = 4, [SB_IMAGE_PROBE] = 16, [SB_IMAGE_PROBE_COLOUR] = 4,
    };
    static const float geometry[4] = {1, 1, 0.25f, 0.5f};
    const enum sb_image_kind kind = request->kind;
    sb_image_init(image, side, side, channels[kind]);
    for (long i = 0; i < (long)side * side; i++) {
        float *at = image->data + i * image->channels;
        if (kind == SB_IMAGE_ID)
            *at = 1;
        else if (kind == SB_IMAGE_GEOMETRY)
            memcpy(at, geometry, sizeof geometry);
        else
            for (int c = 0; c < 4; c++)
                at[c] = colour;
    }
}

static bool null_image(void *self, const struct sb_image_request *request,
                       struct sb_image *image, struct sb_error *err)
{
    struct null_runner *null = self;
    const struct sb_job *job = find_job(null, request->job);
    if (!job)
        return sb_fail(err, SB_INTERNAL, "no job %u", request->job);
    note(null, "image", request->job);
    float colour =
        0.5f + 0.001f * (float)request->off_first + (request->off_count ? 0.1f : 0);
    if (null->script.colour)
        colour = null->script.colour(null->script.user, job, request);
    const int side = request->width ? request->width : 64;
    if (request->kind == SB_IMAGE_SHADOW) {
        draw_cross(image, 0.25f + 0.125f * (float)request->caster);
        return true;
    }
    if (request->kind == SB_IMAGE_ROWS) { // black, and nothing to tell
        const int points =
            request->rows->height / (request->adding > 1 ? request->adding : 1);
        sb_image_init(image, points, 1, request->adding > 1 ? 4 : 16);
        return true;
    }
    const bool one = request->kind == SB_IMAGE_PROBE && request->one_pixel;
    draw_kind(image, request, one ? 1 : side, colour);
    return true;
}

static void null_release(void *self, uint32_t id)
{
    struct null_runner *null = self;
    note(null, "release", id);
    struct sb_job *job = find_job(null, id);
    if (job)
        *job = null->job[--null->job_count];
}

static void null_close(void *self)
{
    struct null_runner *null = self;
    note(null, "close", 0);
    free(null->job);
    free(null);
}

const struct sb_runner_fns sb_runner_null = {
    .name = "null",
    .help = "no GL: scripted times and pictures",
    .open = null_open,
    .audit = null_audit,
    .use_timer = null_use_timer,
    .probe = null_probe,
    .prepare = null_prepare,
    .round = null_round,
    .image = null_image,
    .release = null_release,
    .close = null_close,
};
