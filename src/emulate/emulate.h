// Reduced precision where a driver ignores it: the GLSL ES of a program becomes SPIR-V, the
// result of every RelaxedPrecision operation is rounded there, and comes back as GLSL. So shaders
// stay clean, and it works for anyone's. For accuracy only: how long the result takes says nothing.
#pragma once

#include "base/error.h"
#include "base/mem.h"

// What the numbers of a qualifier are rounded to.
struct sb_emulate_rules {
    enum sb_emulate_lowp {
        SB_LOWP_AS_MEDIUMP, // lowp is binary16 too, as in all hardware known
        SB_LOWP_FIXED10     // 10-bit fixed point: steps of 1/256 in [-2, 2), saturating
    } lowp;
    bool saturate;     // overflow gives the largest finite number, not infinity
    bool flush;        // subnormal results become 0
    bool towards_zero; // rounding; else to nearest even

    // Built-in functions of binary16 miss by the largest error that Vulkan allows half floats
    // ("Precision of core SPIR-V instructions"), and are rounded then; else only rounded:
    //   log2          2^-7 for x in [1/2, 2], else 3 ulp; too small, so that pow is too dark
    //   exp2          1 + 2 |x| ulp, too small likewise, not below 0
    //   pow           by exp2(y * log2(x))
    //   inversesqrt   2 ulp, too large: normalize gives vectors longer than 1
    //   sqrt          by 1 / inversesqrt(x), too small
    //   sin, cos      2^-7, away from 0: past 1, where 1 - sin^2 has no root. Vulkan allows it in
    //                 [-pi, pi] and says nothing of the rest
    // ulp: of the result, at least 2^-24. All that are built on them inherit it: length, distance,
    // normalize, refract. Fixed point has no such table, and is only rounded.
    bool allowed_error;
};

struct sb_emulate_params {
    const char *vertex, *fragment; // GLSL ES 3.00 or 3.10, whole shaders
    struct sb_emulate_rules rules;
    bool gles;   // what comes out: GLSL ES, else desktop GLSL …
    int version; // … of this #version: 300, 310, 330, 450
};

struct sb_emulated {
    const char *vertex, *fragment; // in the arena that was given
    int rounded; // operations, reads and writes whose values are rounded, in both stages
};

// Names of attributes, uniforms, blocks and outputs stay as they are. SB_COMPILE_FAILED with the
// compiler's words where the source is not valid or cannot be translated.
bool sb_emulate(const struct sb_emulate_params *params, struct sb_arena *arena,
                struct sb_emulated *emulated, struct sb_error *err);
