// The values of one axis of a sweep, from words and ranges.
#pragma once

#include "axis/variant.h"

enum { SB_VALUES_MAX = 4096 };

struct sb_values {
    double value[SB_VALUES_MAX];
    int count;
};

// Appends what `text` names: words or numbers, and for a number axis ranges, separated by
// commas. `A..B` and `A..B step S` go up by 1 or S as far as B; `A..B xF` multiplies
// by F.
bool sb_values_add(const struct sb_axes *axes, int axis, const char *text,
                   struct sb_values *values, struct sb_error *err);
