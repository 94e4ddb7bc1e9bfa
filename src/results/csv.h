// CSV as RFC 4180 has it: a header, CRLF-free lines, fields quoted where they must be, numbers
// the C way, empty cells for what was not measured.
#pragma once

#include "base/mem.h"
#include "base/text.h"
#include "results/row.h"

void sb_csv_header(struct sb_text *text, const struct sb_column *columns, int count,
                   const struct sb_axes *axes); // axes: NULL where the file has none
void sb_csv_row(struct sb_text *text, const struct sb_column *columns, int count,
                const struct sb_axes *axes, const void *row);

// One field, quoted where it must be.
void sb_csv_field(struct sb_text *text, const char *field);

// A parsed file: cells as text, all in `arena`.
struct sb_csv {
    char ***cell; // [row][column]; row 0 is the header
    int row_count, column_count;
    struct sb_arena arena;
};

// SB_BAD_INPUT with file:line for rows of another width, open quotes, no header. A last line
// without its end (the writer was killed) is left out.
bool sb_csv_read(const char *path, struct sb_csv *csv, struct sb_error *err);
void sb_csv_free(struct sb_csv *csv);
int sb_csv_column(const struct sb_csv *csv, const char *name); // or -1

// Fills a row from the cells of one line by the column table; columns the file lacks stay
// absent. Texts point into the csv's arena. SB_BAD_INPUT names the cell.
bool sb_csv_get(const struct sb_csv *csv, int line, const struct sb_column *columns,
                int count, void *row, struct sb_error *err);
