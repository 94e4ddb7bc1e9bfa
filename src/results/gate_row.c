#include "results/gate_row.h"

const struct sb_column sb_pair_columns[] = {
#define PAIR(type, name, help)                                                           \
    {#name, help, SB_##type, offsetof(struct sb_pair_row, name)},
#define GATE(type, name, help)
#include "results/gate_columns.def"
#undef PAIR
#undef GATE
};

const struct sb_column sb_gate_columns[] = {
#define PAIR(type, name, help)
#define GATE(type, name, help)                                                           \
    {#name, help, SB_##type, offsetof(struct sb_gate_row, name)},
#include "results/gate_columns.def"
#undef PAIR
#undef GATE
};

const int sb_pair_column_count = sizeof sb_pair_columns / sizeof *sb_pair_columns;
const int sb_gate_column_count = sizeof sb_gate_columns / sizeof *sb_gate_columns;

void sb_pair_row_init(struct sb_pair_row *row)
{
    sb_columns_clear(row, sb_pair_columns, sb_pair_column_count);
}

void sb_gate_row_init(struct sb_gate_row *row)
{
    sb_columns_clear(row, sb_gate_columns, sb_gate_column_count);
}
