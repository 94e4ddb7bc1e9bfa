// What the parts of `compare` share: the rows of a results folder and the axes they lie on.
#pragma once

#include "cli/results.h"

// Each prints text or JSON and returns the exit code.
int sb_compare_pareto(const struct sb_options *options, struct sb_compared *compared);
int sb_compare_terms(const struct sb_options *options, struct sb_compared *compared);
int sb_compare_policies(const struct sb_options *options, struct sb_compared *compared);
int sb_compare_ablation(const struct sb_options *options, struct sb_compared *compared);

// `compare A B`: words 0 and 1 of the options. Judges them, and returns the exit code.
int sb_compare_runs(const struct sb_options *options);

// Does the axis print in other words in some of the rows? Moot counts as a word.
bool sb_compare_varies(const struct sb_compared *compared, int axis);

// Appends " axis=value"; nothing where the axis is moot.
void sb_compare_add_axis(const struct sb_axes *axes, const struct sb_row *row, int axis,
                         struct sb_text *text);

// Appends the driver and its timer where the rows are of more than one.
void sb_compare_add_driver(const struct sb_compared *compared, const struct sb_row *row,
                           struct sb_text *text);

json_t *sb_compare_number(double value); // null where it is not finite
