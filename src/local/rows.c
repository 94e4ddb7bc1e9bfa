// Points of a table, lit by the program "rows" (docs/glsl.md, "Rows").
#include "local/state.h"

#include <string.h>

#include "render/calls.h"

// Channels of what is told of a point, and where in what is captured of a vertex they lie:
// v_diffuse, v_specular, the page.
enum { COLOUR = 4, PAGE = 12, TOLD = COLOUR + PAGE, SPECULAR = 3, CAPTURED = 6 + PAGE };

// --- the table ----------------------------------------------------------------------------

static bool check(const struct sb_local *local, const struct sb_image_request *request,
                  struct sb_error *err)
{
    const struct sb_image *rows = request->rows;
    const int64_t limit = local->caps.texture_size;
    if (!rows || rows->channels != 4 || rows->width < 1 || rows->height < 1)
        return sb_fail(err, SB_BAD_INPUT, "points of a table: there is no table");
    if (rows->width > limit || rows->height > limit)
        return sb_fail(err, SB_OVER_LIMIT,
                       "a table of %d points with %d texels each: this driver's textures "
                       "have up to %lld a side",
                       rows->height, rows->width, (long long)limit);
    if (request->adding > 1 && rows->height % request->adding != 0)
        return sb_fail(err, SB_BAD_INPUT, "%d points cannot be added %d at a time",
                       rows->height, request->adding);
    return local->caps.colour_float ||
           sb_fail(
               err, SB_OVER_LIMIT,
               "points of a table want RGBA32F attachments: this driver draws to none "
               "(colour_float 0)");
}

static GLuint upload(const struct sb_image *rows)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, rows->width, rows->height, 0, GL_RGBA,
                 GL_FLOAT, rows->data);
    return texture;
}

static void set_integer(GLuint program, const char *name, GLint value)
{
    glUniform1i(glGetUniformLocation(program, name), value);
}

static void ask(struct sb_local *local, GLuint program,
                const struct sb_image_request *request)
{
    int64_t calls = 0;
    if (local->no_vertices == 0)
        glGenVertexArrays(1, &local->no_vertices);
    glBindVertexArray(local->no_vertices);
    glUseProgram(program);
    set_integer(program, "u_rows", 0);
    set_integer(program, "u_row_first", 0);
    set_integer(program, "u_row_step", request->adding > 1 ? request->adding : 1);
    set_integer(program, "u_probe_page", (GLint)request->page);
    set_integer(program, "u_probe_light", request->light);
    sb_frame_state(local->caps.gles, &calls);
    glDisable(GL_DEPTH_TEST);
}

// --- lit per fragment ---------------------------------------------------------------------

// The last one is kept: a table is asked for page after page.
static bool make_target(struct sb_local *local, int points, bool added,
                        enum sb_gl_format format, struct sb_error *err)
{
    struct sb_target *target = &local->rows_target;
    const int height = (points + SB_ROW_POINTS_ACROSS - 1) / SB_ROW_POINTS_ACROSS;
    const int more = added ? 0 : SB_TARGET_MORE;
    if (target->framebuffer != 0 && target->height == height &&
        target->more_count == more && target->format == format)
        return true;
    sb_target_free(target);
    const struct sb_target_params params = {SB_ROW_POINTS_ACROSS, height, 1, format};
    if (sb_target_make(target, &local->caps, &params, err) &&
        (added || sb_target_add(target, more, err)))
        return true;
    sb_target_free(target);
    return false;
}

static void draw_pixels(struct sb_local *local, GLuint program, int adding)
{
    const struct sb_target *target = &local->rows_target;
    static const float black[4];
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glViewport(0, 0, target->width, target->height);
    glClearBufferfv(GL_COLOR, 0, black);
    if (adding > 1) {
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    for (int i = 0; i < (adding > 1 ? adding : 1); i++) {
        set_integer(program, "u_row_first", i);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDisable(GL_BLEND);
}

// The picture's pixels are the points, line after line; those behind the last do not matter.
static void keep_points(struct sb_image *picture, int points, struct sb_image *image)
{
    sb_image_init(image, points, 1, picture->channels);
    memcpy(image->data, picture->data,
           (size_t)points * (size_t)picture->channels * sizeof *image->data);
    sb_image_free(picture);
}

static bool pixels(struct sb_local *local, struct sb_local_job *job,
                   const struct sb_image_request *request, struct sb_image *image,
                   struct sb_error *err)
{
    const bool added = request->adding > 1;
    const int points = request->rows->height / (added ? request->adding : 1);
    const enum sb_gl_format format = added ? job->shape.format : SB_GL_RGBA32F;
    if (!make_target(local, points, added, format, err))
        return false;
    const struct sb_target *target = &local->rows_target;
    const struct sb_target_part all = {0, 0, target->width, target->height};
    struct sb_image picture = {0};
    draw_pixels(local, job->program[SB_LOCAL_ROWS].name, request->adding);
    if (!sb_local_read(job, target, &all, &picture, err))
        return false;
    keep_points(&picture, points, image);
    return true;
}

// --- lit per vertex -----------------------------------------------------------------------

static void put_vertex(const float *captured, enum sb_probe_page page, float *to)
{
    memcpy(to, captured, 3 * sizeof *to);
    memcpy(to + COLOUR, captured + CAPTURED - PAGE, PAGE * sizeof *to);
    if (page == SB_PROBE_FRAME)
        memcpy(to + COLOUR, captured + SPECULAR, 3 * sizeof *to);
}

static bool vertices(struct sb_local *local, struct sb_local_job *job,
                     const struct sb_image_request *request, struct sb_image *image,
                     struct sb_error *err)
{
    const int points = request->rows->height;
    const GLsizeiptr size = (GLsizeiptr)points * CAPTURED * (GLsizeiptr)sizeof(float);
    GLuint buffer;
    // Drawing wants a complete framebuffer, even where all is discarded.
    if (!make_target(local, 1, false, SB_GL_RGBA32F, err))
        return false;
    glBindFramebuffer(GL_FRAMEBUFFER, local->rows_target.framebuffer);
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, size, NULL, GL_STREAM_READ);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, points);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    const float *mapped =
        glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, size, GL_MAP_READ_BIT);
    const bool ok =
        sb_local_gl_ok("capturing the points of", job->id, err) &&
        (mapped || sb_fail(err, SB_GL_ERROR, "the driver maps no captured points"));
    if (ok) {
        sb_image_init(image, points, 1, TOLD);
        for (int i = 0; i < points; i++)
            put_vertex(mapped + (size_t)i * CAPTURED, request->page,
                       image->data + (size_t)i * TOLD);
    }
    if (mapped)
        glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glDeleteBuffers(1, &buffer);
    return ok;
}

// --- both ---------------------------------------------------------------------------------

bool sb_local_rows_image(struct sb_local *local, struct sb_local_job *job,
                         const struct sb_image_request *request, struct sb_image *image,
                         struct sb_error *err)
{
    if (!check(local, request, err))
        return false;
    const bool vertex = sb_lit_per_vertex(&job->variant);
    if (vertex && request->adding > 1)
        return sb_fail(
            err, SB_BAD_INPUT,
            "stage=vertex: points lit per vertex are not drawn, so they cannot "
            "be added");
    const GLuint texture = upload(request->rows);
    ask(local, job->program[SB_LOCAL_ROWS].name, request);
    const bool ok = vertex ? vertices(local, job, request, image, err)
                           : pixels(local, job, request, image, err);
    glDeleteTextures(1, &texture);
    return ok;
}
