// GLSL ES to SPIR-V, by glslang.
#pragma once

#include <stdint.h>

#include "base/error.h"
#include "base/mem.h"

struct sb_spirv {
    uint32_t *word; // in an arena
    size_t count;
};

// The text of a vertex or fragment shader without macros and comments, each line where it was.
// NULL: SB_COMPILE_FAILED.
char *sb_source_preprocess(const char *source, bool fragment, struct sb_arena *arena,
                           struct sb_error *err);

// Of a preprocessed text of GLSL ES 3.10. Functions that nothing calls are kept; uniforms and
// interface variables have a location or binding only where the text gives one.
bool sb_spirv_compile(const char *source, bool fragment, struct sb_arena *arena,
                      struct sb_spirv *spirv, struct sb_error *err);
