// Edits to the text of shaders, before they are compiled and after they are written back.
#pragma once

#include "base/text.h"
#include "emulate/compile.h"

enum { SB_SHARED_BLOCKS = 16 };
struct sb_source {
    char *text; // preprocessed, of GLSL ES 3.10, in the arena
    // Blocks of layout(shared), which SPIR-V cannot say: they go through it as std140.
    const char *shared[SB_SHARED_BLOCKS];
    int shared_count;
    bool bindings; // it says binding = somewhere
};

// SB_COMPILE_FAILED with the compiler's words, or where the version is neither 300 es nor 310 es.
bool sb_source_read(const char *source, bool fragment, struct sb_arena *arena,
                    struct sb_source *read, struct sb_error *err);

// Appends the text with another word for each that equals `from`.
void sb_source_swap(const char *text, const char *from, const char *to,
                    struct sb_text *out);

// Appends what came back, with blocks as the source had them: without instance name, shared.
void sb_source_restore(const struct sb_source *read, const char *text,
                       struct sb_text *out);
