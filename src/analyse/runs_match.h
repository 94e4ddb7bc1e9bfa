// Which rows of two runs are the same.
#pragma once

#include "analyse/runs.h"

// A run's rows as words: an axis that the run does not have is at -1.
struct sb_run_words {
    const struct sb_run_side *side;
    int axis[2 * SB_AXIS_MAX]; // the place in side->axes of each axis of either run
    const char **word;         // SB_AXIS_MAX a row; "" where the axis is moot
};

struct sb_run_match {
    struct sb_run_words a, b;
    const struct sb_axis *axis[2 * SB_AXIS_MAX]; // of either run; shorthand is left out
    int axis_count;
    int *partner; // of each row of A, in B; -1: none
    struct sb_arena arena;
};

// The word of row i on axis `axis` of the match; "" where it is moot, or the run lacks it.
const char *sb_run_word(const struct sb_run_words *words, int i, int axis);

// Both sides are borrowed.
void sb_run_match_make(struct sb_run_match *match, const struct sb_run_side *a,
                       const struct sb_run_side *b);
void sb_run_match_free(struct sb_run_match *match);
