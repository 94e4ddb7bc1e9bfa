#include "results/history_row.h"

const struct sb_column sb_history_columns[] = {
#define HISTORY(type, name, help)                                                        \
    {#name, help, SB_##type, offsetof(struct sb_history_row, name)},
#include "results/history_columns.def"
#undef HISTORY
};

const int sb_history_column_count =
    sizeof sb_history_columns / sizeof *sb_history_columns;

void sb_history_row_init(struct sb_history_row *row)
{
    sb_columns_clear(row, sb_history_columns, sb_history_column_count);
}
