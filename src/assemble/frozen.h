// A program whose final texts were kept: drawn as they stand, whatever the shader folder says now.
#pragma once

#include "assemble/assemble.h"

struct sb_frozen {
    const char *vertex, *fragment; // final GLSL, as `show` printed it
};

struct sb_frozen_params {
    const struct sb_frozen *frozen; // its texts are copied
    const char *scene;
    const struct sb_variant
        *variant; // that the texts are of: resolved, and nothing in it `auto`
    const struct sb_caps *caps;
    uint32_t id; // of the job
};

// An assembly of one program "shade", which lights all draws of the scene. SB_BAD_INPUT where the
// context is of the other API. *assembly must be zeroed; free also after failure.
bool sb_assemble_frozen(const struct sb_frozen_params *params,
                        struct sb_assembly *assembly, struct sb_error *err);
