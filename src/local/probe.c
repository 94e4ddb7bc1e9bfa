// What the programs "probe" and "inputs" draw and tell (docs/glsl.md, "Probes").
#include "local/state.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

// Of what is captured of a vertex: v_diffuse, v_specular, the page.
enum { PAGE = 12, SPECULAR = 3, CAPTURED_PAGE = 6, CAPTURED = CAPTURED_PAGE + PAGE };

// --- the program -------------------------------------------------------------------------

static bool bind(const struct sb_local_job *job, GLuint program,
                 struct sb_binding *binding, struct sb_error *err)
{
    const struct sb_binding_params params = {
        .program = program,
        .upload = &job->scene->upload,
        .variant = &job->variant,
    };
    return sb_binding_make(binding, &params, err);
}

static enum sb_local_role role_of(const struct sb_image_request *request)
{
    return request->inputs_only ? SB_LOCAL_INPUTS : SB_LOCAL_PROBE;
}

static struct sb_local_probe *probe_of(struct sb_local_job *job,
                                       const struct sb_image_request *request)
{
    return &job->probe[role_of(request) - SB_LOCAL_PROBE];
}

// Made once: a second picture finds it.
static bool make(struct sb_local_job *job, const struct sb_image_request *request,
                 struct sb_error *err)
{
    const enum sb_local_role role = role_of(request);
    struct sb_local_probe *probe = probe_of(job, request);
    if (probe->binding.program != 0)
        return true;
    if (!probe->source.role)
        return sb_fail(err, SB_BAD_INPUT,
                       "job %" PRIu32 " has no program for the role \"%s\": it was "
                       "assembled without one, or for GLSL ES 1.00, which has one output "
                       "only; valid: glsl other than 100",
                       job->id, request->inputs_only ? "inputs" : "probe");
    if (!sb_local_compile_probe(job, role, err) ||
        !bind(job, job->program[role].name, &probe->binding, err))
        goto error;
    sb_shadow_set_units(probe->binding.program);
    return true;

error:
    sb_binding_free(&probe->binding);
    sb_gl_program_free(&job->program[role]);
    return false;
}

static bool make_blank(struct sb_local *local, struct sb_local_job *job,
                       struct sb_error *err)
{
    struct sb_gl_program *program = &local->blank_program;
    if (job->lamp.program == 0 || job->blank.program != 0)
        return true;
    return (program->name != 0 ||
            sb_blank_program_make(program, local->caps.gles, err)) &&
           bind(job, program->name, &job->blank, err);
}

static void ask(GLuint program, const struct sb_image_request *request)
{
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "u_probe_page"), (GLint)request->page);
    glUniform1i(glGetUniformLocation(program, "u_probe_light"), request->light);
}

// --- pixels -----------------------------------------------------------------------------

static bool has_float_targets(const struct sb_local *local, struct sb_error *err)
{
    return local->caps.colour_float ||
           sb_fail(err, SB_OVER_LIMIT,
                   "a probe wants four RGBA32F attachments: this driver draws to none "
                   "(colour_float 0); rgba8 and the picture \"colour\" always work");
}

// The last one is kept: pixels are asked for one by one.
static bool make_target(struct sb_local *local, const struct sb_shape *shape,
                        struct sb_error *err)
{
    struct sb_target *target = &local->probe_target;
    if (target->framebuffer != 0 && target->width == shape->width &&
        target->height == shape->height)
        return true;
    sb_target_free(target);
    const struct sb_target_params params = {shape->width, shape->height, 1,
                                            SB_GL_RGBA32F};
    if (sb_target_make(target, &local->caps, &params, err) &&
        sb_target_add(target, SB_TARGET_MORE, err))
        return true;
    sb_target_free(target);
    return false;
}

static bool is_inside(const struct sb_shape *shape,
                      const struct sb_image_request *request, struct sb_error *err)
{
    if (!request->one_pixel || (request->x >= 0 && request->x < shape->width &&
                                request->y >= 0 && request->y < shape->height))
        return true;
    return sb_fail(
        err, SB_BAD_INPUT, "pixel (%d, %d) of job %" PRIu32 "; valid: 0 to %d, 0 to %d",
        request->x, request->y, request->job, shape->width - 1, shape->height - 1);
}

static struct sb_frame_params frame_of(const struct sb_local *local,
                                       struct sb_local_job *job,
                                       const struct sb_image_request *request,
                                       const struct sb_target *target)
{
    struct sb_frame_params frame = sb_local_frame(local, job);
    frame.binding = &probe_of(job, request)->binding;
    frame.binding_count = 1;
    frame.target = target;
    frame.layers = 1;
    frame.blank = &job->blank;
    return frame;
}

static bool pixels(struct sb_local *local, struct sb_local_job *job,
                   const struct sb_image_request *request, struct sb_image *image,
                   struct sb_error *err)
{
    const struct sb_shape shape = sb_local_shape(job, request);
    if (!has_float_targets(local, err) || !is_inside(&shape, request, err) ||
        !make_blank(local, job, err) || !make_target(local, &shape, err))
        return false;
    const int at[2] = {request->x, request->y};
    struct sb_frame_params frame = frame_of(local, job, request, &local->probe_target);
    struct sb_target_part part = {0, 0, shape.width, shape.height};
    if (request->one_pixel) {
        frame.pixel = at;
        part = (struct sb_target_part){request->x, request->y, 1, 1};
    }
    sb_local_still(job, frame.binding, 1, request);
    sb_frame_draw(&frame);
    sb_local_lights_on(frame.binding, 1, request);
    return sb_local_read(job, &local->probe_target, &part, image, err);
}

static bool colour(struct sb_local *local, struct sb_local_job *job,
                   const struct sb_image_request *request, struct sb_image *image,
                   struct sb_error *err)
{
    struct sb_shape shape = sb_local_shape(job, request);
    shape.format = sb_format_wide(&local->caps);
    shape.samples = 1;
    struct sb_shared_ring *ring =
        sb_pool_ring_get(&local->pool, &local->caps, &shape, err);
    if (!ring)
        return false;
    const struct sb_target_part all = {0, 0, shape.width, shape.height};
    const struct sb_target *target = &ring->ring.target[0];
    const struct sb_frame_params frame = frame_of(local, job, request, target);
    sb_local_still(job, frame.binding, 1, request);
    sb_frame_draw(&frame);
    sb_local_lights_on(frame.binding, 1, request);
    const bool ok = sb_local_read(job, target, &all, image, err);
    sb_pool_ring_put(&local->pool, ring);
    return ok;
}

// --- vertices ---------------------------------------------------------------------------

static void put_vertex(const float *captured, enum sb_probe_page page, float *to)
{
    memcpy(to, captured, 3 * sizeof *to);
    memcpy(to + 4, captured + CAPTURED_PAGE, PAGE * sizeof *to);
    if (page == SB_PROBE_FRAME)
        memcpy(to + 4, captured + SPECULAR, 3 * sizeof *to);
}

static bool vertices(const struct sb_local *local, struct sb_local_job *job,
                     const struct sb_image_request *request, struct sb_image *image,
                     struct sb_error *err)
{
    const int64_t count = sb_capture_vertices(&job->scene->scene);
    float *values = sb_alloc((size_t)count * CAPTURED * sizeof *values);
    const struct sb_capture_params params = {
        .binding = &probe_of(job, request)->binding,
        .shadow = job->shadow.casters > 0 ? &job->shadow : NULL,
        .target = &job->ring->ring.target[0],
        .floats = CAPTURED,
        .gles = local->caps.gles,
    };
    sb_local_still(job, params.binding, 1, request);
    sb_capture_draw(&params, values);
    sb_local_lights_on(params.binding, 1, request);
    const bool ok = sb_local_gl_ok("capturing the vertices of", job->id, err);
    if (ok) {
        sb_image_init(image, (int)count, 1, 4 + PAGE);
        for (int64_t i = 0; i < count; i++)
            put_vertex(values + i * CAPTURED, request->page,
                       image->data + i * image->channels);
    }
    free(values);
    return ok;
}

bool sb_local_probe_image(struct sb_local *local, struct sb_local_job *job,
                          const struct sb_image_request *request, struct sb_image *image,
                          struct sb_error *err)
{
    if (request->inputs_only && request->kind == SB_IMAGE_PROBE &&
        request->page == SB_PROBE_LIGHT)
        return sb_fail(err, SB_BAD_INPUT,
                       "job %" PRIu32 ": the program \"inputs\" tells nothing of lights; "
                       "valid: the pages of inputs, frame and maps",
                       job->id);
    if (!make(job, request, err))
        return false;
    ask(probe_of(job, request)->binding.program, request);
    if (request->kind == SB_IMAGE_PROBE_COLOUR)
        return colour(local, job, request, image, err);
    // Maps are read by fragments, wherever they are lit.
    if (sb_lit_per_vertex(&job->variant) && request->page != SB_PROBE_MAPS)
        return vertices(local, job, request, image, err);
    return pixels(local, job, request, image, err);
}
