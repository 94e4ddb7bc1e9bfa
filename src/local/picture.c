// Pictures of a job: what its own program draws, and which draw each pixel shows.
#include "local/state.h"

static bool read_back(const struct sb_local_job *job, const struct sb_target *target,
                      struct sb_image *image, struct sb_error *err)
{
    return sb_local_gl_ok("drawing the picture of", job->id, err) &&
           sb_target_read(target, image, err);
}

static bool colour(const struct sb_local *local, struct sb_local_job *job,
                   const struct sb_image_request *request, const struct sb_target *target,
                   struct sb_image *image, struct sb_error *err)
{
    const bool off = request->off_count > 0, moved = job->binding.phase_count > 1;
    struct sb_frame_params frame = sb_local_frame(local, job);
    frame.target = target;
    if (off || moved)
        sb_binding_lights(&job->binding, request->off_first, request->off_count);
    if (job->shadow.phase_count > 1)
        sb_shadow_draw(&job->shadow, &job->shadow.phase[0]);
    sb_frame_draw(&frame);
    // Before the read, which waits: no upload may be left over for the next batch.
    if (off)
        sb_binding_lights(&job->binding, 0, 0);
    return read_back(job, target, image, err);
}

static bool ids(const struct sb_local *local, const struct sb_local_job *job,
                const struct sb_target *target, struct sb_image *image,
                struct sb_error *err)
{
    const struct sb_binding_params params = {
        .program = local->id_program.name,
        .upload = &job->scene->upload,
        .variant = &job->variant,
    };
    struct sb_binding binding;
    bool ok = sb_binding_make(&binding, &params, err);
    if (ok) {
        sb_frame_draw(&(struct sb_frame_params){
            .binding = &binding,
            .target = target,
            .layers = 1,
            .phase = -1,
            .gles = local->caps.gles,
        });
        ok = read_back(job, target, image, err);
    }
    sb_binding_free(&binding);
    return ok;
}

static bool shadow_map(const struct sb_local *local, const struct sb_local_job *job,
                       int caster, struct sb_image *image, struct sb_error *err)
{
    if (job->shadow.phase_count > 1)
        sb_shadow_draw(&job->shadow, &job->shadow.phase[0]);
    return sb_shadow_read(&job->shadow, &local->caps, caster, image, err);
}

bool sb_local_image(void *self, const struct sb_image_request *request,
                    struct sb_image *image, struct sb_error *err)
{
    struct sb_local *local = self;
    struct sb_local_job *job = sb_local_job_find(local, request->job, err);
    if (!job)
        return false;
    if (request->kind == SB_IMAGE_SHADOW)
        return shadow_map(local, job, request->caster, image, err);
    struct sb_shape shape = job->shape;
    if (request->width > 0)
        shape.width = request->width;
    if (request->height > 0)
        shape.height = request->height;
    if (request->kind == SB_IMAGE_ID) {
        shape.format = SB_GL_R32UI;
        shape.samples = 1;
    } else if (request->wide) {
        shape.format = sb_format_wide(&local->caps);
    }

    // At its own size and format that is the ring that the job is measured in.
    struct sb_shared_ring *ring =
        sb_pool_ring_get(&local->pool, &local->caps, &shape, err);
    if (!ring)
        return false;
    const struct sb_target *target = &ring->ring.target[0];
    const bool ok = request->kind == SB_IMAGE_ID
                        ? ids(local, job, target, image, err)
                        : colour(local, job, request, target, image, err);
    sb_pool_ring_put(&local->pool, ring);
    return ok;
}
