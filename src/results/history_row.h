// Rows of a history: the cost of a variant, at a commit, over that of the anchor.
#pragma once

#include "results/row.h"

struct sb_history_row {
#define HISTORY(type, name, help) sb_cell_##type name;
#include "results/history_columns.def"
#undef HISTORY
};

extern const struct sb_column sb_history_columns[];
extern const int sb_history_column_count;

// A row with every cell absent.
void sb_history_row_init(struct sb_history_row *row);
