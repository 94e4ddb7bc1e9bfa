// A CSV file of a results folder that grows row by row: whatever was added is on disk.
#pragma once

#include "base/error.h"
#include "results/row.h"

struct sb_row_file; // opaque

struct sb_row_file_params {
    const char *dir, *name; // "cases.csv"
    const struct sb_column *column;
    int column_count;
};

// Makes the folder. SB_BAD_INPUT where it cannot be made or written, or has such a file with rows
// already.
struct sb_row_file *sb_row_file_open(const struct sb_row_file_params *params,
                                     struct sb_error *err);
// Appends `count` rows of `size` bytes each: all of them or, SB_WRITE_FAILED, none; the rows before
// them are whole.
bool sb_row_file_add(struct sb_row_file *file, const void *rows, int count, size_t size,
                     struct sb_error *err);
// All rows anew, where later measurements have added to them.
bool sb_row_file_replace(struct sb_row_file *file, const void *rows, int count,
                         size_t size, struct sb_error *err);
const char *sb_row_file_path(const struct sb_row_file *file);
void sb_row_file_close(struct sb_row_file **file);
