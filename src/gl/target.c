#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "gl/target.h"

struct format {
    const char *name;
    GLenum internal;
    int channels;
    // The pair that GLES 3.0 (4.3.2) grants for reading this kind of buffer.
    GLenum read_format, read_type;
};

// clang-format off
static const struct format formats[] = {
    [SB_GL_RGBA8]   = {"rgba8",   GL_RGBA8,   4, GL_RGBA,         GL_UNSIGNED_BYTE},
    [SB_GL_RGBA16F] = {"rgba16f", GL_RGBA16F, 4, GL_RGBA,         GL_FLOAT},
    [SB_GL_RGBA32F] = {"rgba32f", GL_RGBA32F, 4, GL_RGBA,         GL_FLOAT},
    [SB_GL_R32UI]   = {"r32ui",   GL_R32UI,   1, GL_RGBA_INTEGER, GL_UNSIGNED_INT},
    [SB_GL_RGBA32UI] = {"rgba32ui", GL_RGBA32UI, 4, GL_RGBA_INTEGER, GL_UNSIGNED_INT},
};
// clang-format on

static bool fits(const struct sb_caps *caps, const struct sb_target_params *params,
                 struct sb_error *err)
{
    const int64_t limit = caps->renderbuffer_size;
    const enum sb_gl_format format = params->format;
    if (params->width < 1 || params->height < 1 || params->width > limit ||
        params->height > limit)
        return sb_fail(err, SB_OVER_LIMIT,
                       "a target of %d x %d pixels: this driver takes 1 to %lld a side",
                       params->width, params->height, (long long)limit);
    if ((format == SB_GL_RGBA32F && !caps->colour_float) ||
        (format == SB_GL_RGBA16F && !caps->colour_half))
        return sb_fail(err, SB_OVER_LIMIT,
                       "target %s: this driver cannot draw to it; rgba8 always works",
                       formats[format].name);
    if (params->samples < 1 || (params->samples > 1 && params->samples > caps->samples))
        return sb_fail(err, SB_OVER_LIMIT,
                       "%d samples a pixel: this driver takes 1 to %lld (GL_MAX_SAMPLES)",
                       params->samples,
                       (long long)(caps->samples > 1 ? caps->samples : 1));
    return true;
}

static GLuint attach(GLenum attachment, GLenum internal,
                     const struct sb_target_params *params, int samples)
{
    GLuint name;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    if (samples > 1)
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, internal,
                                         params->width, params->height);
    else
        glRenderbufferStorage(GL_RENDERBUFFER, internal, params->width, params->height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    return name;
}

// The framebuffer bound is whole, and has as many samples as were asked for: a driver may
// give more (OpenGL 4.6 core, 9.2.4), which would be another variant.
static bool complete(const struct sb_caps *caps, const struct sb_target_params *params,
                     struct sb_error *err)
{
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    const char *error = sb_gl_error();
    if (error || status != GL_FRAMEBUFFER_COMPLETE)
        return sb_fail(err, SB_OVER_LIMIT,
                       "a %s target of %d x %d pixels and %d samples: the driver refused "
                       "it (%s, framebuffer status 0x%04x; its limits are %lld pixels a "
                       "side and %lld samples)",
                       formats[params->format].name, params->width, params->height,
                       params->samples, error ? error : "no error", (unsigned)status,
                       (long long)caps->renderbuffer_size, (long long)caps->samples);
    if (params->samples > 1 && samples != params->samples)
        return sb_fail(
            err, SB_OVER_LIMIT,
            "%d samples a pixel: this driver makes %d of them for a %s target; valid "
            "here: 1 or %d, at most %lld (GL_MAX_SAMPLES)",
            params->samples, samples, formats[params->format].name, samples,
            (long long)caps->samples);
    return true;
}

bool sb_target_make(struct sb_target *target, const struct sb_caps *caps,
                    const struct sb_target_params *params, struct sb_error *err)
{
    const GLenum internal = formats[params->format].internal;
    *target = (struct sb_target){
        .width = params->width,
        .height = params->height,
        .samples = params->samples,
        .format = params->format,
    };
    if (!fits(caps, params, err))
        goto error;
    if (params->samples > 1) {
        glGenFramebuffers(1, &target->resolved);
        glBindFramebuffer(GL_FRAMEBUFFER, target->resolved);
        target->resolved_colour = attach(GL_COLOR_ATTACHMENT0, internal, params, 1);
    }
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    target->colour = attach(GL_COLOR_ATTACHMENT0, internal, params, params->samples);
    target->depth =
        attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, params, params->samples);
    if (!complete(caps, params, err))
        goto error;
    return true;

error:
    sb_target_free(target);
    return false;
}

bool sb_target_add(struct sb_target *target, int count, struct sb_error *err)
{
    const struct sb_target_params params = {target->width, target->height, 1,
                                            target->format};
    GLenum buffers[1 + SB_TARGET_MORE] = {GL_COLOR_ATTACHMENT0};
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    for (int i = 0; i < count; i++) {
        buffers[1 + i] = GL_COLOR_ATTACHMENT1 + (GLenum)i;
        target->more[i] =
            attach(buffers[1 + i], formats[target->format].internal, &params, 1);
    }
    target->more_count = count;
    glDrawBuffers(1 + count, buffers);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    const char *error = sb_gl_error();
    if (!error && status == GL_FRAMEBUFFER_COMPLETE)
        return true;
    return sb_fail(
        err, SB_OVER_LIMIT,
        "a %s target of %d x %d pixels with %d attachments: the driver refused "
        "it (%s, framebuffer status 0x%04x; GL_MAX_COLOR_ATTACHMENTS is at "
        "least 4)",
        formats[target->format].name, target->width, target->height, 1 + count,
        error ? error : "no error", (unsigned)status);
}

void sb_target_free(struct sb_target *target)
{
    glDeleteFramebuffers(1, &target->framebuffer); // 0 is ignored
    glDeleteFramebuffers(1, &target->resolved);
    glDeleteRenderbuffers(1, &target->depth);
    glDeleteRenderbuffers(1, &target->colour);
    glDeleteRenderbuffers(SB_TARGET_MORE, target->more);
    glDeleteRenderbuffers(1, &target->resolved_colour);
    *target = (struct sb_target){0};
}

int64_t sb_target_resolve(const struct sb_target *target)
{
    if (target->samples == 1)
        return 0;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target->resolved);
    glBlitFramebuffer(0, 0, target->width, target->height, 0, 0, target->width,
                      target->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    // Read from here on: reading pixels of a multisampled framebuffer is an error.
    glBindFramebuffer(GL_FRAMEBUFFER, target->resolved);
    return 3;
}

// What was read of one attachment, into its place among the channels of the image.
static void put(const struct format *format, const void *raw, int first,
                struct sb_image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        float *to = image->data + i * (size_t)image->channels + first;
        for (int c = 0; c < format->channels; c++) {
            const size_t from = 4 * i + (size_t)c;
            if (format->read_type == GL_UNSIGNED_BYTE)
                to[c] = (float)((const unsigned char *)raw)[from] / 255.0f;
            else if (format->internal == GL_R32UI)
                to[c] = (float)((const GLuint *)raw)[from];
            else
                memcpy(&to[c], (const float *)raw + from, sizeof to[c]);
        }
    }
}

bool sb_target_read_part(const struct sb_target *target,
                         const struct sb_target_part *part, struct sb_image *image,
                         struct sb_error *err)
{
    const struct format *format = &formats[target->format];
    // Every read format has 4 channels, of at most 4 bytes.
    void *raw = sb_alloc((size_t)part->width * (size_t)part->height * 16);
    sb_image_init(image, part->width, part->height,
                  format->channels * (1 + target->more_count));
    glBindFramebuffer(GL_READ_FRAMEBUFFER,
                      target->samples > 1 ? target->resolved : target->framebuffer);
    for (int i = 0; i <= target->more_count; i++) {
        glReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)i);
        glReadPixels(part->x, part->y, part->width, part->height, format->read_format,
                     format->read_type, raw);
        put(format, raw, i * format->channels, image);
    }
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    free(raw);
    const char *error = sb_gl_error();
    if (!error)
        return true;
    sb_image_free(image);
    return sb_fail(err, SB_GL_ERROR, "%s when reading a %s target of %d x %d pixels",
                   error, format->name, target->width, target->height);
}

bool sb_target_read(const struct sb_target *target, struct sb_image *image,
                    struct sb_error *err)
{
    const struct sb_target_part all = {0, 0, target->width, target->height};
    return sb_target_read_part(target, &all, image, err);
}
