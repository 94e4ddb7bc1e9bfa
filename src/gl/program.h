// Programs: compiled, linked, timed.
#pragma once

#include <stdint.h>

#include "gl/gl.h"

struct sb_gl_program {
    GLuint name;                // 0: failed
    double compile_ms, link_ms; // until the status was known
    // 0: the driver gives no binary. Equal hashes: the same code. Unequal ones may be the
    // same code too: Mesa writes the number of the shader object into its binaries.
    uint64_t binary_hash;
    enum sb_failed_stage failed_stage;
    char *log; // malloc'd, or NULL; of the failed stage
};

// Overwrites *program; source->role does not matter. Attributes a_position, a_normal, a_uv,
// a_tangent get locations 0 to 3. Shaders are compiled in this thread (max shader compiler
// threads 0 where the driver has them). On false, failed_stage and log say what the driver
// refused; sb_gl_program_free frees the log in either case.
bool sb_gl_program_make(const struct sb_program *source, struct sb_gl_program *program);
// The same of a program whose varyings are captured by transform feedback, in this order, one
// vertex behind the other.
bool sb_gl_program_make_captured(const struct sb_program *source,
                                 const char *const *varying, int count,
                                 struct sb_gl_program *program);
void sb_gl_program_free(struct sb_gl_program *program); // zeroes it
