// The pass: rounds the results of all operations of reduced precision.
#pragma once

#include "emulate/module.h"

struct sb_rounding {
    struct sb_spirv spirv; // without RelaxedPrecision
    int rounded;           // instructions whose result is rounded
};

// The module must hold the functions of emulate/helpers.h. Names are those of emulate/rename.h.
void sb_module_round(const struct sb_module *module, bool bindings,
                     struct sb_arena *arena, struct sb_rounding *rounding);
