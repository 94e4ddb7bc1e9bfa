// Programs: compiled, linked, timed.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "gl/gl.h"

struct sb_gl_program {
    GLuint name;                // 0: failed
    double compile_ms, link_ms; // until the status was known
    // 0: the driver gives no binary. Equal hashes: the same code. Unequal ones may be the
    // same code too: Mesa writes the number of the shader object into its binaries.
    uint64_t binary_hash;
    bool cached; // loaded from a program cache (gl/program_cache.h): link_ms is of that
    enum sb_failed_stage failed_stage;
    char *log; // malloc'd, or NULL; of the failed stage
};

// Names of the attributes; each is bound to its place here as its location.
enum { SB_GL_ATTRIBUTES = 4 };
extern const char *const sb_gl_attributes[SB_GL_ATTRIBUTES];

// Overwrites *program; source->role does not matter. Shaders are compiled in this thread (max shader compiler
// threads 0 where the driver has them). On false, failed_stage and log say what the driver
// refused; sb_gl_program_free frees the log in either case.
bool sb_gl_program_make(const struct sb_program *source, struct sb_gl_program *program);
// The same of a program whose varyings are captured by transform feedback, in this order, one
// vertex behind the other.
bool sb_gl_program_make_captured(const struct sb_program *source,
                                 const char *const *varying, int count,
                                 struct sb_gl_program *program);
// What the driver gives of a linked program, *size bytes of it in *format; free(). NULL: nothing.
unsigned char *sb_gl_program_binary(GLuint name, GLenum *format, size_t *size);
void sb_gl_program_free(struct sb_gl_program *program); // zeroes it
