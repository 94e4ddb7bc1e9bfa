// Synthetic loads for the timer audit: whole frames, bound by one stage, whose cost is
// set by one number.
#pragma once

#include "gl/program.h"
#include "gl/target.h"

enum { SB_LOAD_RING = 2 };

struct sb_gl_load {
    struct sb_gl_program program;
    struct sb_target ring[SB_LOAD_RING];
    GLuint vertex_array;
    GLint loops; // location of the uniform
    int vertices;
};

// A load on targets of size x size pixels, drawn once; sets all the state that it needs.
// *load must be zeroed; sb_gl_load_free also after failure.
bool sb_gl_load_make(struct sb_gl_load *load, enum sb_load kind, int size,
                     const struct sb_caps *caps, struct sb_error *err);
void sb_gl_load_free(struct sb_gl_load *load);

void sb_gl_load_set_loops(const struct sb_gl_load *load, int loops);

// Draws whole frames over the ring, the last one left bound. Does not wait.
void sb_gl_load_draw(const struct sb_gl_load *load, int frames);
