// What `run` and `compare` print of rows: tables, and JSON.
#pragma once

#include <jansson.h>

#include "cli/keys.h"

// Rows in the plan's order. Errors and the front have columns where any row has errors.
void sb_report_table(const struct sb_axes *axes, const struct sb_row *row, int count);
json_t *sb_report_json(const struct sb_axes *axes, const struct sb_row *row, int count);

// Two cells: the median in ms, and its interval's larger half in percent of it.
void sb_report_level(struct sb_table *table, const struct sb_row *row);

// sb_pareto_text with what sets the dominator apart from the other rows of `keys`.
void sb_report_mark(const struct sb_keys *keys, const struct sb_row *row,
                    struct sb_text *text);

// A cell of a row of any results file; null where it is absent, or not finite.
json_t *sb_report_cell_json(const void *row, const struct sb_column *column);

// What each policy saves, and what each effect that is left out costs; nothing where there are no
// such rows.
void sb_report_policies(const struct sb_axes *axes, const struct sb_row *row, int count);
void sb_report_ablation(const struct sb_axes *axes, const struct sb_row *row, int count);
