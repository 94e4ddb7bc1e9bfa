// Variants with emulated precision: their lit programs are put together as GLSL ES, which has
// precision, and translated to the context's GLSL with every operation rounded.
#pragma once

#include "assemble/decide.h"
#include "glsl/glsl.h"

// Does this variant want reduced precision emulated?
bool sb_is_emulated(const struct sb_variant *variant);

// SB_BAD_INPUT where the context's version cannot hold what emulates.
bool sb_decide_emulation(const struct sb_glsl_version *version,
                         const struct sb_variant *variant, struct sb_error *err);

// The version that such a program is put together in.
const struct sb_glsl_version *sb_emulated_source_version(
    const struct sb_variant *variant);

// Replaces the texts of a vertex and a fragment shader by their emulation, in the context's
// version. Their line maps then say "(generated)" throughout.
bool sb_emulate_sources(const struct sb_variant *variant,
                        const struct sb_glsl_version *version,
                        struct sb_glsl_source *vertex, struct sb_glsl_source *fragment,
                        struct sb_error *err);
