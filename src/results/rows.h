// Reads summary.csv back: its rows, each with its variant.
#pragma once

#include "results/csv.h"

// One line of a parsed summary.csv. Axes that the file lacks or leaves empty (moot) keep the
// value that *variant comes with; its given bits stay, too. row->axes is `variant`, texts point
// into the csv. SB_BAD_INPUT names the cell, but not the file.
bool sb_rows_get(const struct sb_csv *csv, int line, const struct sb_axes *axes,
                 struct sb_variant *variant, struct sb_row *row, struct sb_error *err);

struct sb_rows {
    struct sb_row *row; // in the file's order
    struct sb_variant *variant;
    int count;
    struct sb_csv csv; // owns the texts
};

// The whole file. What was given is read from the ids. SB_BAD_INPUT with file:line where it
// holds no row, lacks a column that says what a row is, has an axis that `axes` does not know,
// or a cell that is none. *rows must be zeroed; free also after failure.
bool sb_rows_read(const char *path, const struct sb_axes *axes, struct sb_rows *rows,
                  struct sb_error *err);
void sb_rows_free(struct sb_rows *rows);

// The preset that a row's id begins with, or "" where it begins with an axis. Lives in `text`.
const char *sb_row_preset(const struct sb_row *row, struct sb_text *text);
