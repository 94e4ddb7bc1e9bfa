// Only what main() reaches: of a text without macros and comments, every function, struct and
// variable that nothing in use names is taken out.
#pragma once

#include "glsl/glsl.h"

// Replaces the source's text, and with it line map and hash. `plain` is the same text preprocessed,
// each line where the source has it. What is left depends on nothing that is not used: two
// programs that do the same have the same text. Overloads, and whatever shares a name with
// something in use, stay; a text that is not understood stays as it is in `plain`.
void sb_glsl_reduce(struct sb_glsl_source *source, const char *plain);
