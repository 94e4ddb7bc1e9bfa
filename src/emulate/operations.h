// How each operation on floats is rounded.
#pragma once

#include <stdint.h>

enum sb_operation_kind {
    SB_COPY,    // no business of ours
    SB_MOVE,    // hands values on: exact, but for constants among them
    SB_CHANGE,  // exact in binary16, but may leave the range of fixed point: -(-2)
    SB_COMPARE, // the result is no float
    SB_ROUND,   // the result is rounded
    SB_EXPAND // a function stands for it, which rounds, all its operations where it has several
};

struct sb_operation {
    uint16_t op; // of SPIR-V, or of GLSL.std.450
    uint8_t kind;
    uint8_t first, count; // operands that may be floats: their words
    const char *function; // SB_EXPAND: its name without suffix
};

enum { SB_ALL_OPERANDS = 255 };

// Of the instruction at `word`; NULL: of no interest. GLSL.std.450 has the id `extensions`.
const struct sb_operation *sb_operation_of(const uint32_t *word, uint32_t extensions);
