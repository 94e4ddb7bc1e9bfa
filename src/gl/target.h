// Off-screen targets: a colour attachment and a depth attachment.
#pragma once

#include "gl/gl.h"
#include "image/image.h"

enum sb_gl_format {
    SB_GL_RGBA8,
    SB_GL_RGBA16F,
    SB_GL_RGBA32F,
    SB_GL_R32UI,
    SB_GL_RGBA32UI // bits of floats
};

enum { SB_TARGET_MORE = 3 };
struct sb_target {
    GLuint framebuffer, colour,
        depth; // drawn to; colour and depth (24 bits) are renderbuffers
    GLuint resolved, resolved_colour; // read from where samples > 1; else 0
    GLuint more[SB_TARGET_MORE];      // attachments behind the first, as it is
    int more_count;
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
// Gives a target of one sample `count` attachments more, up to SB_TARGET_MORE, for the outputs
// from location 1. Leaves the framebuffer bound. SB_OVER_LIMIT where the driver refuses them.
bool sb_target_add(struct sb_target *target, int count, struct sb_error *err);
void sb_target_free(struct sb_target *target); // zeroes it

// Ends drawing to the target, whose framebuffer must be bound: where it is multisampled, its
// samples are averaged into what is read. Leaves the framebuffer that is read bound. Returns
// the number of GL calls it made.
int64_t sb_target_resolve(const struct sb_target *target);

struct sb_target_part {
    int x, y, width, height; // pixels, from the lower left one
};

// Reads the colour, as last resolved, back as floats: 4 channels (R32UI: 1 channel, exact up
// to 2^24; RGBA32UI: the floats whose bits were drawn), of all attachments one behind the other.
// Waits for the drawing. Initialises *image, which the caller frees; on false
// there is nothing to free. Leaves the framebuffer bound for reading.
bool sb_target_read(const struct sb_target *target, struct sb_image *image,
                    struct sb_error *err);
// The same of a part that lies inside.
bool sb_target_read_part(const struct sb_target *target,
                         const struct sb_target_part *part, struct sb_image *image,
                         struct sb_error *err);
