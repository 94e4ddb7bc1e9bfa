// Which rows of a run differ in nothing but what is looked at.
#pragma once

#include "results/row.h"

struct sb_alike {
    const struct sb_axes *axes;
    const struct sb_row *row;
    int count;
    bool free[SB_AXIS_MAX]; // axes that may differ; shorthand is always free
    bool *moot;             // SB_AXIS_MAX values a row
};

// Rows are borrowed; `free` is copied, NULL: none.
void sb_alike_make(struct sb_alike *alike, const struct sb_axes *axes,
                   const struct sb_row *row, int count, const bool *free);
void sb_alike_free(struct sb_alike *alike);

// Do rows number a and b have one scene, driver, timer and kind of interval, and the same value
// on every axis that is neither free nor moot for one of them? A moot axis goes with every
// value: without a spot light the cone is neither smooth nor hard. So this is no equivalence.
bool sb_alike(const struct sb_alike *alike, int a, int b);

// Has it a time that may be used: a status that does not fail the run, and a median above 0?
bool sb_row_has_time(const struct sb_row *row);
