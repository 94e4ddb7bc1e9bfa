// Off-screen targets: a colour attachment and a depth attachment.
#pragma once

#include "gl/gl.h"
#include "image/image.h"

enum sb_gl_format { SB_GL_RGBA8, SB_GL_RGBA16F, SB_GL_RGBA32F, SB_GL_R32UI };

struct sb_target {
    GLuint framebuffer, colour,
        depth; // drawn to; colour and depth (24 bits) are renderbuffers
    GLuint resolved, resolved_colour; // read from where samples > 1; else 0
    int width, height, samples;
    enum sb_gl_format format;
};

struct sb_target_params {
    int width, height; // pixels
    int samples;       // a pixel; 1: no multisampling
    enum sb_gl_format format;
};

// Leaves the framebuffer bound, its content undefined. SB_OVER_LIMIT where the size, the
// format or exactly this number of samples is not to be had; then *target is all zeros.
bool sb_target_make(struct sb_target *target, const struct sb_caps *caps,
                    const struct sb_target_params *params, struct sb_error *err);
void sb_target_free(struct sb_target *target); // zeroes it

// Ends drawing to the target, whose framebuffer must be bound: where it is multisampled, its
// samples are averaged into what is read. Leaves the framebuffer that is read bound. Returns
// the number of GL calls it made.
int64_t sb_target_resolve(const struct sb_target *target);

// Reads the colour, as last resolved, back as floats: 4 channels (R32UI: 1 channel, exact up
// to 2^24). Waits for the drawing. Initialises *image, which the caller frees; on false
// there is nothing to free. Leaves the framebuffer bound for reading.
bool sb_target_read(const struct sb_target *target, struct sb_image *image,
                    struct sb_error *err);
