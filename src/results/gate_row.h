// Rows of the files of a gate: structs made from gate_columns.def, and the tables of them.
#pragma once

#include "results/row.h"

struct sb_pair_row {
#define PAIR(type, name, help) sb_cell_##type name;
#define GATE(type, name, help)
#include "results/gate_columns.def"
#undef PAIR
#undef GATE
};

struct sb_gate_row {
#define PAIR(type, name, help)
#define GATE(type, name, help) sb_cell_##type name;
#include "results/gate_columns.def"
#undef PAIR
#undef GATE
};

extern const struct sb_column sb_pair_columns[], sb_gate_columns[];
extern const int sb_pair_column_count, sb_gate_column_count;

// Rows with every cell absent.
void sb_pair_row_init(struct sb_pair_row *row);
void sb_gate_row_init(struct sb_gate_row *row);
