// Specialised programs hold what they use and nothing else, so that two draws that call for the same
// have one text.
#pragma once

#include "glsl/glsl.h"

// Preprocesses the texts of a vertex and a fragment shader and takes out what main() does not reach.
// SB_COMPILE_FAILED where the preprocessor refuses one.
bool sb_reduce_sources(struct sb_glsl_source *vertex, struct sb_glsl_source *fragment,
                       struct sb_error *err);
