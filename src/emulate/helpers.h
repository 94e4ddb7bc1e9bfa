// The functions in GLSL that an instrumented program calls: rounding, and the formulas of the
// built-in functions with every operation rounded. Only those that are called come out.
#pragma once

#include "base/text.h"
#include "emulate/emulate.h"

// Behind the name of every function: what it rounds to.
#define SB_ROUND_16 "_16" // binary16
#define SB_ROUND_10 "_10" // fixed point of 10 bits, where the rules want it

// Appends text for the end of a shader of GLSL ES 3.10.
void sb_emulate_helpers(const struct sb_emulate_rules *rules, struct sb_text *text);
