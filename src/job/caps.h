// The caps table, for printing.
#pragma once

#include "job/job.h"

struct sb_caps_row {
    const char *name, *help;
    bool text;
    size_t offset;
};
extern const struct sb_caps_row sb_caps_rows[];
extern const int sb_caps_row_count;
