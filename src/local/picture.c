// Pictures of a job: what its own program draws, and which draw each pixel shows.
#include "local/state.h"

static void draw(const struct sb_local *local, const struct sb_binding *binding,
                 const struct sb_target *target, int layers)
{
    sb_frame_draw(&(struct sb_frame_params){
        .binding = binding,
        .target = target,
        .layers = layers,
        .gles = local->caps.gles,
    });
}

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
    const bool off = request->off_count > 0;
    if (off)
        sb_binding_lights(&job->binding, request->off_first, request->off_count);
    draw(local, &job->binding, target, job->shape.layers);
    // Before the read, which waits: no upload may be left over for the next batch.
    if (off)
        sb_binding_lights(&job->binding, 0, 0);
    return read_back(job, target, image, err);
}

static bool ids(const struct sb_local *local, const struct sb_local_job *job,
                const struct sb_target *target, struct sb_image *image,
                struct sb_error *err)
{
    struct sb_binding binding;
    bool ok = sb_binding_make(&binding, local->id_program.name, &job->scene->upload, err);
    if (ok) {
        draw(local, &binding, target, 1);
        ok = read_back(job, target, image, err);
    }
    sb_binding_free(&binding);
    return ok;
}

bool sb_local_image(void *self, const struct sb_image_request *request,
                    struct sb_image *image, struct sb_error *err)
{
    struct sb_local *local = self;
    struct sb_local_job *job = sb_local_job_find(local, request->job, err);
    if (!job)
        return false;
    struct sb_shape shape = job->shape;
    if (request->width > 0)
        shape.width = request->width;
    if (request->height > 0)
        shape.height = request->height;
    if (request->kind == SB_IMAGE_ID)
        shape.format = SB_GL_R32UI;
    else if (request->wide)
        shape.format = sb_format_wide(&local->caps);

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
