// A text table with aligned columns.
#pragma once

#include <stdbool.h>

struct sb_table; // opaque

struct sb_table *sb_table_new(void);
void sb_table_free(struct sb_table **table);

// Columns first, then cells row by row; a NULL cell prints empty.
void sb_table_column(struct sb_table *table, const char *title, bool right);
void sb_table_cell(struct sb_table *table, const char *text);
void sb_table_cellf(struct sb_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// `format` takes one double, such as "%.2f"; NAN prints empty.
void sb_table_real(struct sb_table *table, const char *format, double value);
void sb_table_print(const struct sb_table *table); // to stdout
