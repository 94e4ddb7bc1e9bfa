// What a variant leaves open, decided by what the driver has.
#pragma once

#include "job/job.h"

struct sb_glsl_version { // one value of the glsl axis
    int value;           // SB_GLSL_330
    const char *text;    // what follows #version: "330 core"
    int64_t number;      // as caps.glsl counts: 330
    bool gles;
    const char *family; // GLSL_FAMILY, and a file in shaders/version/
};

// The row of a value of the glsl axis; NULL for auto.
const struct sb_glsl_version *sb_glsl_version_of(int value);

// Decides glsl=auto and writes the value into the variant; NULL with SB_BAD_INPUT, which
// names the valid words, where the context cannot take the version.
const struct sb_glsl_version *sb_decide_version(const struct sb_axes *axes,
                                                const struct sb_caps *caps,
                                                struct sb_variant *variant,
                                                struct sb_error *err);

// Decides storage=auto and writes the value into the variant. Call after the version.
// SB_OVER_LIMIT where the lights fit nowhere, or not where the variant wants them;
// SB_BAD_INPUT where that storage cannot do what else the variant wants.
bool sb_decide_storage(const struct sb_axes *axes, const struct sb_caps *caps,
                       struct sb_variant *variant, struct sb_error *err);

// Do the variant's shadow maps want what GLSL ES 3.00 lacks and 3.10 has by extensions: cube
// map arrays or geometry shaders?
bool sb_shadows_want_es310(const struct sb_variant *variant);

// Can this driver do the variant's shadows? Call after the version. SB_OVER_LIMIT names the
// limit, what the driver has and what would fit; SB_BAD_INPUT where the variant contradicts
// itself.
bool sb_decide_shadows(const struct sb_axes *axes, const struct sb_caps *caps,
                       const struct sb_variant *variant, struct sb_error *err);

// SB_BAD_INPUT where the GLSL version has no such loop. Call after the version.
// text=as_written: SB_BAD_INPUT where the variant leaves nothing of the text's slips, or asks
// for what they replace.
bool sb_decide_slips(const struct sb_axes *axes, const struct sb_variant *variant,
                     struct sb_error *err);

bool sb_decide_loop(const struct sb_variant *variant, struct sb_error *err);
