// Pictures of a job: what its own program draws, which draw each pixel shows, and where in it.
#include "local/state.h"

bool sb_local_read(const struct sb_local_job *job, const struct sb_target *target,
                   const struct sb_target_part *part, struct sb_image *image,
                   struct sb_error *err)
{
    return sb_local_gl_ok("drawing the picture of", job->id, err) &&
           sb_target_read_part(target, part, image, err);
}

static bool read_back(const struct sb_local_job *job, const struct sb_target *target,
                      struct sb_image *image, struct sb_error *err)
{
    const struct sb_target_part all = {0, 0, target->width, target->height};
    return sb_local_read(job, target, &all, image, err);
}

void sb_local_still(const struct sb_local_job *job, const struct sb_binding *binding,
                    int binding_count, const struct sb_image_request *request)
{
    for (int i = 0; i < binding_count; i++)
        if (request->off_count > 0 || binding[i].phase_count > 1)
            sb_binding_lights(&binding[i], request->off_first, request->off_count);
    if (job->shadow.phase_count > 1)
        sb_shadow_draw(&job->shadow, &job->shadow.phase[0]);
}

void sb_local_lights_on(const struct sb_binding *binding, int binding_count,
                        const struct sb_image_request *request)
{
    for (int i = 0; request->off_count > 0 && i < binding_count; i++)
        sb_binding_lights(&binding[i], 0, 0);
}

static bool colour(const struct sb_local *local, struct sb_local_job *job,
                   const struct sb_image_request *request, const struct sb_target *target,
                   struct sb_image *image, struct sb_error *err)
{
    struct sb_frame_params frame = sb_local_frame(local, job);
    frame.target = target;
    sb_local_still(job, frame.binding, frame.binding_count, request);
    sb_frame_draw(&frame);
    sb_local_lights_on(frame.binding, frame.binding_count, request);
    return read_back(job, target, image, err);
}

// A picture by a program of the runner's own.
static bool draw_with(const struct sb_local *local, const struct sb_local_job *job,
                      const struct sb_gl_program *program, const struct sb_upload *upload,
                      const struct sb_target *target, struct sb_image *image,
                      struct sb_error *err)
{
    const struct sb_binding_params params = {
        .program = program->name,
        .upload = upload,
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

static bool geometry(struct sb_local *local, const struct sb_local_job *job,
                     const struct sb_target *target, struct sb_image *image,
                     struct sb_error *err)
{
    struct sb_gl_program *program = &local->geometry_program;
    if (program->name == 0 && !sb_geometry_program_make(program, local->caps.gles, err))
        return false;
    struct sb_upload triangles;
    sb_upload_make_triangles(&triangles, &job->scene->scene);
    const bool ok = draw_with(local, job, program, &triangles, target, image, err);
    sb_upload_free(&triangles);
    return ok;
}

static bool shadow_map(const struct sb_local *local, const struct sb_local_job *job,
                       int caster, struct sb_image *image, struct sb_error *err)
{
    if (job->shadow.phase_count > 1)
        sb_shadow_draw(&job->shadow, &job->shadow.phase[0]);
    return sb_shadow_read(&job->shadow, &local->caps, caster, image, err);
}

struct sb_shape sb_local_shape(const struct sb_local_job *job,
                               const struct sb_image_request *request)
{
    struct sb_shape shape = job->shape;
    if (request->width > 0)
        shape.width = request->width;
    if (request->height > 0)
        shape.height = request->height;
    if (request->single)
        shape.samples = 1;
    return shape;
}

// SB_IMAGE_COLOUR, SB_IMAGE_ID and SB_IMAGE_GEOMETRY: of one target.
static bool picture(struct sb_local *local, struct sb_local_job *job,
                    const struct sb_image_request *request, struct sb_image *image,
                    struct sb_error *err)
{
    struct sb_shape shape = sb_local_shape(job, request);
    if (request->kind != SB_IMAGE_COLOUR) {
        shape.format = request->kind == SB_IMAGE_ID ? SB_GL_R32UI : SB_GL_RGBA32UI;
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
    bool ok;
    if (request->kind == SB_IMAGE_ID)
        ok = draw_with(local, job, &local->id_program, &job->scene->upload, target, image,
                       err);
    else if (request->kind == SB_IMAGE_GEOMETRY)
        ok = geometry(local, job, target, image, err);
    else
        ok = colour(local, job, request, target, image, err);
    sb_pool_ring_put(&local->pool, ring);
    return ok;
}

bool sb_local_image(void *self, const struct sb_image_request *request,
                    struct sb_image *image, struct sb_error *err)
{
    struct sb_local *local = self;
    struct sb_local_job *job = sb_local_job_find(local, request->job, err);
    if (!job)
        return false;
    if ((request->kind == SB_IMAGE_ROWS) != (job->scene == NULL))
        return sb_fail(
            err, SB_BAD_INPUT,
            "job %u: points of a table are told by jobs of a program \"rows\", "
            "and pictures by all others",
            (unsigned)request->job);
    switch (request->kind) {
    case SB_IMAGE_ROWS:
        return sb_local_rows_image(local, job, request, image, err);
    case SB_IMAGE_SHADOW:
        return shadow_map(local, job, request->caster, image, err);
    case SB_IMAGE_PROBE_COLOUR:
    case SB_IMAGE_PROBE:
        return sb_local_probe_image(local, job, request, image, err);
    default:
        return picture(local, job, request, image, err);
    }
}
