// The macros that every shader of a variant begins with.
#pragma once

#include "axis/variant.h"
#include "effects/effects.h"
#include "glsl/glsl.h"
#include "scene/lights.h"

// Of the light structs two macros each, and some of which there is one.
enum {
    SB_DEFINE_MAX = SB_AXIS_MAX + 2 * SB_EFFECT_COUNT + 2 * SB_LIGHT_STRUCT_COUNT + 12
};

struct sb_defines {
    struct sb_glsl_define row[SB_DEFINE_MAX];
    int count;
    struct sb_arena *arena; // the caller's: holds the texts
    // Set before sb_defines_make:
    uint32_t left_out; // effects that the variant calls for and this program does without
    bool switched;     // effects that can be are decided at run time
};

// Every axis that has a macro, and what follows from several axes together: the effects, the
// light counts and array sizes, the repetitions of loop=unrolled, the slips of a text. The
// variant must have no `auto` left. SB_BAD_INPUT where an axis of a suite takes a name twice.
bool sb_defines_make(struct sb_defines *defines, const struct sb_axes *axes,
                     const struct sb_variant *variant, const char *family,
                     struct sb_error *err);

// PROBE is `off` after sb_defines_make; `on` and `inputs`: in the programs "probe" and "inputs".
void sb_defines_probe(struct sb_defines *defines, const char *value);

// GIVEN is `interpolated` after sb_defines_make; `rows`, with STORAGE `rows`: in the program "rows".
void sb_defines_rows(struct sb_defines *defines, bool rows);

// Another GLSL_FAMILY than that of sb_defines_make.
void sb_defines_family(struct sb_defines *defines, const char *family);
