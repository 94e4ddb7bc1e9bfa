// Preparing and releasing jobs.
#include "local/state.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "gl/statistics.h"

bool sb_local_gl_ok(const char *what, uint32_t job, struct sb_error *err)
{
    const char *word = sb_gl_error();
    if (!word)
        return true;
    return sb_fail(err, SB_GL_ERROR, "%s job %" PRIu32 ": the driver reports %s", what,
                   job, word);
}

struct sb_local_job *sb_local_job_find(const struct sb_local *local, uint32_t id,
                                       struct sb_error *err)
{
    for (struct sb_local_job *job = local->jobs; job; job = job->next) {
        if (job->id == id)
            return job;
    }
    sb_fail(err, SB_INTERNAL, "job %" PRIu32 " is not prepared, or was released", id);
    return NULL;
}

static void job_free(struct sb_local *local, struct sb_local_job *job)
{
    sb_pool_ring_put(&local->pool, job->half);
    sb_pool_ring_put(&local->pool, job->ring);
    sb_local_lit_free(&job->lit);
    sb_binding_free(&job->lamp);
    for (int i = 0; i < SB_LOCAL_PROBES; i++)
        sb_binding_free(&job->probe[i].binding);
    sb_binding_free(&job->blank);
    sb_shadow_free(&job->shadow);
    sb_shadow_free(&job->unused_shadow);
    for (int role = 0; role < SB_LOCAL_ROLE_COUNT; role++)
        sb_gl_program_free(&job->program[role]);
    sb_pool_scene_put(&local->pool, job->scene);
    free(job);
}

static bool shows_lamps(const struct sb_scene *scene)
{
    for (int i = 0; i < scene->draw_count; i++) {
        if (scene->draw[i].lamp >= 0)
            return true;
    }
    return false;
}

// A program for all scenes may be able to look up more casters than this one has.
static void make_unused_shadows(struct sb_local_job *job, const struct sb_job *request)
{
    for (int i = 0; i < request->lit_count; i++)
        if (sb_shadow_casters(&request->lit[i].variant) >
                sb_shadow_casters(&job->variant) &&
            job->unused_shadow.casters == 0)
            sb_shadow_make_unused(&job->unused_shadow, &request->lit[i].variant);
}

// The maps, drawn once: where the casters stand still, that is all that is drawn of them.
static bool make_shadows(const struct sb_local *local, struct sb_local_job *job,
                         struct sb_error *err)
{
    if (sb_shadow_casters(&job->variant) == 0)
        return true;
    const struct sb_shadow_params params = {
        .program = job->program[SB_LOCAL_SHADOW].name,
        .upload = &job->scene->upload,
        .variant = &job->variant,
        .caps = &local->caps,
    };
    if (!sb_local_has_role(job, SB_LOCAL_SHADOW, err) ||
        !sb_shadow_make(&job->shadow, &params, err))
        return false;
    sb_shadow_draw(&job->shadow, &job->shadow.phase[0]);
    return sb_local_gl_ok("drawing the shadow maps of", job->id, err);
}

static bool bind_programs(struct sb_local_job *job, const struct sb_job *request,
                          struct sb_error *err)
{
    if (!sb_local_lit_bind(job, request, err))
        return false;
    for (int i = 0; i < job->lit.program_count; i++)
        sb_shadow_set_units(job->lit.program[i].name);
    if (!shows_lamps(&job->scene->scene))
        return true;
    const struct sb_binding_params params = {
        .program = job->program[SB_LOCAL_LAMP].name,
        .upload = &job->scene->upload,
        .variant = &job->variant,
    };
    return sb_local_has_role(job, SB_LOCAL_LAMP, err) &&
           sb_binding_make(&job->lamp, &params, err);
}

// The first frame in the exact state that is measured: drivers compile for the state, not
// only for the program. Two more, since some recompile after the first draw.
static void warm_up(struct sb_local *local, const struct sb_local_job *job,
                    struct sb_prepared *result)
{
    const struct sb_shot first = {.job = job->id, .frames = 1, .shrink = 1};
    const struct sb_shot more = {.job = job->id, .frames = 2, .shrink = 1};
    struct sb_sample sample;
    sb_local_batch(local, job, &job->ring->ring, &first, NULL, &sample,
                   &result->gl_calls);
    result->first_draw_ms = (double)sample.wall_ns * 1e-6;
    sb_local_batch(local, job, &job->ring->ring, &more, NULL, &sample, NULL);
}

static bool count_work(struct sb_local *local, const struct sb_local_job *job,
                       struct sb_prepared *result)
{
    result->vertices = sb_scene_triangles(&job->scene->scene) * 3 * job->shape.layers;
    result->casters = job->shadow.casters;
    result->draws_shadows = job->shadow.phase_count > 1;
    result->programs = job->lit.program_count;
    result->switches = sb_local_lit_switches(&job->lit, job->shape.layers);
    if (result->draws_shadows)
        result->vertices += sb_shadow_vertices(&job->shadow);

    struct sb_image id = {0};
    const struct sb_image_request request = {.job = job->id, .kind = SB_IMAGE_ID};
    if (!sb_local_image(local, &request, &id, &result->error))
        return false;
    for (long i = 0; i < (long)id.width * id.height; i++)
        result->fragments += id.data[i] != 0;
    result->fragments *= job->shape.layers;
    sb_image_free(&id);
    return true;
}

static bool is_rows(const struct sb_job *request)
{
    return request->program_count == 1 && strcmp(request->program->role, "rows") == 0;
}

// Points of a table have no scene, no frame and no time.
static bool prepare_rows(struct sb_local *local, const struct sb_job *request,
                         struct sb_prepared *result)
{
    struct sb_local_job *job = sb_alloc(sizeof *job);
    job->id = request->id;
    job->variant = request->variant;
    job->shape = sb_shape_of(&request->variant);
    if (!sb_local_compile_rows(job, request, result) ||
        !sb_local_gl_ok("preparing", job->id, &result->error)) {
        job_free(local, job);
        return false;
    }
    job->next = local->jobs;
    local->jobs = job;
    return true;
}

static bool prepare(struct sb_local *local, const struct sb_job *request,
                    struct sb_prepared *result)
{
    struct sb_error *err = &result->error;
    if (sb_local_job_find(local, request->id, NULL))
        return sb_fail(err, SB_INTERNAL, "job %" PRIu32 " is prepared already",
                       request->id);
    if (is_rows(request))
        return prepare_rows(local, request, result);

    struct sb_local_job *job = sb_alloc(sizeof *job);
    job->id = request->id;
    job->cache = local->cache;
    job->variant = request->variant;
    job->shape = sb_shape_of(&request->variant);
    job->scene = sb_pool_scene_get(&local->pool, request->scene, &request->variant, err);
    if (!job->scene || !sb_local_gl_ok("uploading the scene of", job->id, err))
        goto error;
    result->input_hash = job->scene->hash;
    job->ring = sb_pool_ring_get(&local->pool, &local->caps, &job->shape, err);
    if (!job->ring)
        goto error;
    if (!sb_local_compile(job, request, result) || !bind_programs(job, request, err) ||
        !make_shadows(local, job, err))
        goto error;
    make_unused_shadows(job, request);
    job->next = local->jobs;
    local->jobs = job;
    warm_up(local, job, result);
    if (sb_local_gl_ok("preparing", job->id, err) && count_work(local, job, result))
        return true;
    sb_local_release(local, job->id);
    return false;

error:
    job_free(local, job);
    return false;
}

bool sb_local_prepare(void *self, const struct sb_job *request,
                      struct sb_prepared *result)
{
    struct sb_local *local = self;
    struct sb_text said = {0};
    *result = (struct sb_prepared){0};
    if (local->driver_stats)
        sb_gl_statistics_begin(&said);
    const bool good = prepare(local, request, result);
    if (local->driver_stats)
        sb_gl_statistics_end();
    snprintf(result->driver_stats, sizeof result->driver_stats, "%s", sb_text_get(&said));
    sb_text_free(&said);
    return good;
}

void sb_local_release(void *self, uint32_t id)
{
    struct sb_local *local = self;
    for (struct sb_local_job **link = &local->jobs; *link; link = &(*link)->next) {
        struct sb_local_job *job = *link;
        if (job->id == id) {
            *link = job->next;
            job_free(local, job);
            return;
        }
    }
}
