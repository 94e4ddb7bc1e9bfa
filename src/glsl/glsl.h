// GLSL sources from files: includes resolved, one flat text, and a map back to the files.
// Knows nothing of axes.
//
// A file may say
//     #include "lights/point.glsl"                    relative to the shader folder
//     #include "attenuation/$(ATTENUATION).glsl"      $(NAME): value of a define below
//     #define unit unit_$(F_UNIT)                     in every line that begins with #
// A text that the caller gives under a name stands in for a file of that name. Each file is
// included once, whatever #if it stands under; files that include each other
// are an error. Nothing else is preprocessed: the driver does the rest.
#pragma once

#include <stdint.h>

#include "base/error.h"
#include "base/mem.h"
#include "base/text.h"

struct sb_glsl_define {
    const char *name, *value; // a name may have a parameter: "IF_CONE(code)"
};

struct sb_glsl_text { // found by #include before the folder is asked
    const char *name, *text;
};

struct sb_glsl_params {
    const char *root;    // the shader folder
    const char *file;    // the first file, relative to root
    const char *version; // "330 core", "300 es": the #version line, which comes first
    const struct sb_glsl_define *define; // then these, one #define a line
    int define_count;
    const struct sb_glsl_text *given;
    int given_count;
};

struct sb_glsl_line { // where a line of the flat text came from
    int file;         // place in file_name; -1: the head, of no file
    int line;         // from 1
};
struct sb_glsl_source {
    char *text;
    struct sb_glsl_line *line;
    int line_count;
    const char **file_name; // relative to root, or of a given text
    int file_count;
    uint64_t hash;         // of the text
    struct sb_arena arena; // owns all of the above
};

// Errors name file:line of the #include that failed. *source must be zeroed; free also
// after failure.
bool sb_glsl_build(const struct sb_glsl_params *params, struct sb_glsl_source *source,
                   struct sb_error *err);
void sb_glsl_free(struct sb_glsl_source *source);

// Rewrites a compiler's log so that each message names the original file and line, or
// "(generated)". Knows the forms of Mesa "0:12(5): error", NVIDIA "0(12) : error C", AMD,
// Apple and glslang "ERROR: 0:12:", Mali "0:12:"; other lines stay as they are.
void sb_glsl_explain(const struct sb_glsl_source *source, const char *log,
                     struct sb_text *text);
