// The Pareto front over time and error: which rows no other row beats.
//
// A row dominates another only with equal scene axes, target and platform, if its time interval
// lies wholly below and it is no worse in max_err, p999_err, flip_mean and nonfinite.
#pragma once

#include "results/row.h"

struct sb_pareto_params {
    struct sb_row *row;
    int count;
    const struct sb_axes *axes;
    // Scenes whose truth is a closed form: there, axes flagged SB_TRUTH are quality. NULL: none.
    bool (*analytic)(const char *scene);
};

// May the two be ranked against each other? Equal scene, driver, timer, kind of interval and
// input, and equal on the axes of kind platform and scene and on those flagged SB_APART. An
// equivalence: it sorts rows into groups, each with a front of its own.
bool sb_pareto_comparable(const struct sb_pareto_params *params, const struct sb_row *a,
                          const struct sb_row *b);

// Is the axis one that the rows of a group agree on? As sb_pareto_comparable has it.
bool sb_pareto_keeps_apart(const struct sb_axis *axis);

// Fills front, dominated_by, dominated_time and dominated_err of every row; whatever they held
// is lost. A row without an interval, without errors, with a status that fails the run, or with
// a value flagged SB_UNTIMED is neither front nor dominated. Of the rows that dominate one, the
// one named is on the front and has the least max_err, then the least median_ms. Texts are
// literals or the rows' own ids. dominated_err is 1 where neither errs, and infinite where the
// dominator alone does not.
void sb_pareto_mark(const struct sb_pareto_params *params);

// The marks in words: `front` or `dominated by ID (1.90 times slower, 3.21 times the error)`, where
// `id` stands for dominated_by; appends nothing to `text` for a row that is neither.
void sb_pareto_text(const struct sb_row *row, const char *id, struct sb_text *text);
