#include <stdlib.h>

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
};
// clang-format on

static bool fits(const struct sb_caps *caps, int width, int height,
                 enum sb_gl_format format, struct sb_error *err)
{
    const int64_t limit = caps->renderbuffer_size;
    if (width < 1 || height < 1 || width > limit || height > limit)
        return sb_fail(err, SB_OVER_LIMIT,
                       "a target of %d x %d pixels: this driver takes 1 to %lld a side",
                       width, height, (long long)limit);
    if ((format == SB_GL_RGBA32F && !caps->colour_float) ||
        (format == SB_GL_RGBA16F && !caps->colour_half))
        return sb_fail(err, SB_OVER_LIMIT,
                       "target %s: this driver cannot draw to it; rgba8 always works",
                       formats[format].name);
    return true;
}

bool sb_target_make(struct sb_target *target, const struct sb_caps *caps, int width,
                    int height, enum sb_gl_format format, struct sb_error *err)
{
    *target = (struct sb_target){.width = width, .height = height, .format = format};
    if (!fits(caps, width, height, format, err))
        goto error;
    glGenRenderbuffers(1, &target->colour);
    glBindRenderbuffer(GL_RENDERBUFFER, target->colour);
    glRenderbufferStorage(GL_RENDERBUFFER, formats[format].internal, width, height);
    glGenRenderbuffers(1, &target->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, target->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              target->colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                              target->depth);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    const char *error = sb_gl_error();
    if (error || status != GL_FRAMEBUFFER_COMPLETE) {
        sb_fail(err, SB_OVER_LIMIT,
                "a %s target of %d x %d pixels: the driver refused it (%s, framebuffer "
                "status 0x%04x)",
                formats[format].name, width, height, error ? error : "no error",
                (unsigned)status);
        goto error;
    }
    return true;

error:
    sb_target_free(target);
    return false;
}

void sb_target_free(struct sb_target *target)
{
    glDeleteFramebuffers(1, &target->framebuffer); // 0 is ignored
    glDeleteRenderbuffers(1, &target->depth);
    glDeleteRenderbuffers(1, &target->colour);
    *target = (struct sb_target){0};
}

bool sb_target_read(const struct sb_target *target, struct sb_image *image,
                    struct sb_error *err)
{
    const struct format *format = &formats[target->format];
    const size_t pixels = (size_t)target->width * (size_t)target->height;
    // Every read format has 4 channels, of at most 4 bytes.
    void *raw = sb_alloc(pixels * 16);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadPixels(0, 0, target->width, target->height, format->read_format,
                 format->read_type, raw);
    const char *error = sb_gl_error();
    if (error) {
        free(raw);
        return sb_fail(err, SB_GL_ERROR, "%s when reading a %s target of %d x %d pixels",
                       error, format->name, target->width, target->height);
    }
    sb_image_init(image, target->width, target->height, format->channels);
    for (size_t i = 0; i < pixels * (size_t)format->channels; i++) {
        if (format->read_type == GL_FLOAT)
            image->data[i] = ((const float *)raw)[i];
        else if (format->read_type == GL_UNSIGNED_BYTE)
            image->data[i] = (float)((const unsigned char *)raw)[i] / 255.0f;
        else
            image->data[i] = (float)((const GLuint *)raw)[4 * i];
    }
    free(raw);
    return true;
}
