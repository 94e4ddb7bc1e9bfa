// Preparing and releasing jobs.
#include "local/state.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

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
    sb_binding_free(&job->binding);
    sb_gl_program_free(&job->program);
    sb_pool_scene_put(&local->pool, job->scene);
    free(job);
}

static bool compile(struct sb_local_job *job, const struct sb_job *request,
                    struct sb_prepared *result)
{
    static const char *const stages[] = {
        [SB_STAGE_LINK] = "the program does not link",
        [SB_STAGE_VERT] = "the vertex shader does not compile",
        [SB_STAGE_FRAG] = "the fragment shader does not compile",
    };
    int place = 0;
    while (place < request->program_count &&
           strcmp(request->program[place].role, "shade") != 0)
        place++;
    if (place == request->program_count)
        return sb_fail(&result->error, SB_BAD_INPUT,
                       "job %" PRIu32 " has no program for the role \"shade\"",
                       request->id);
    const struct sb_program *source = &request->program[place];
    const bool ok = sb_gl_program_make(source->vertex, source->fragment, &job->program);
    result->compile_ms = job->program.compile_ms;
    result->link_ms = job->program.link_ms;
    result->binary_hash = job->program.binary_hash;
    if (ok)
        return true;
    result->failed_program = place;
    result->failed_stage = job->program.failed_stage;
    result->log = sb_strdup(job->program.log ? job->program.log : "");
    const size_t line = strcspn(result->log, "\n");
    return sb_fail(&result->error, SB_COMPILE_FAILED, "%s: %.*s",
                   stages[result->failed_stage], (int)(line < 800 ? line : 800),
                   result->log);
}

// The first frame in the exact state that is measured: drivers compile for the state, not
// only for the program. Two more, since some recompile after the first draw.
static void warm_up(struct sb_local *local, const struct sb_local_job *job,
                    struct sb_prepared *result)
{
    struct sb_sample sample;
    sb_local_batch(local, job, &job->ring->ring, 1, &sample, &result->gl_calls);
    result->first_draw_ms = (double)sample.wall_ns * 1e-6;
    sb_local_batch(local, job, &job->ring->ring, 2, &sample, NULL);
}

static bool count_work(struct sb_local *local, const struct sb_local_job *job,
                       struct sb_prepared *result)
{
    result->vertices = sb_scene_triangles(&job->scene->scene) * 3 * job->shape.layers;

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

bool sb_local_prepare(void *self, const struct sb_job *request,
                      struct sb_prepared *result)
{
    struct sb_local *local = self;
    *result = (struct sb_prepared){0};
    struct sb_error *err = &result->error;
    if (sb_local_job_find(local, request->id, NULL))
        return sb_fail(err, SB_INTERNAL, "job %" PRIu32 " is prepared already",
                       request->id);

    struct sb_local_job *job = sb_alloc(sizeof *job);
    job->id = request->id;
    job->shape = sb_shape_of(&request->variant);
    job->scene = sb_pool_scene_get(&local->pool, request->scene, &request->variant, err);
    if (!job->scene || !sb_local_gl_ok("uploading the scene of", job->id, err))
        goto error;
    result->input_hash = job->scene->hash;
    job->ring = sb_pool_ring_get(&local->pool, &local->caps, &job->shape, err);
    if (!job->ring)
        goto error;
    if (!compile(job, request, result))
        goto error;
    if (!sb_binding_make(&job->binding, job->program.name, &job->scene->upload, err))
        goto error;
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
