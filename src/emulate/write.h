// SPIR-V to GLSL, by SPIRV-Cross.
#pragma once

#include "base/text.h"
#include "emulate/compile.h"

// Appends the text. SB_COMPILE_FAILED with its words where this version of GLSL cannot say it.
bool sb_spirv_write(const struct sb_spirv *spirv, bool gles, int version,
                    struct sb_text *text, struct sb_error *err);
