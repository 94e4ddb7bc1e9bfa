// cases.csv of a results folder: a row is on disk before the next cell is asked.
#pragma once

#include "base/error.h"
#include "results/row.h"

struct sb_case_file; // opaque

// Makes the folder. SB_BAD_INPUT where it cannot be made or written, or has a cases.csv with rows
// already.
struct sb_case_file *sb_case_file_open(const char *dir, struct sb_error *err);
// Appends a row. SB_WRITE_FAILED; the rows before it are whole.
bool sb_case_file_add(struct sb_case_file *file, const struct sb_case_row *row,
                      struct sb_error *err);
// All rows anew, where later measurements have added to them.
bool sb_case_file_replace(struct sb_case_file *file, const struct sb_case_row *rows,
                          int count, struct sb_error *err);
const char *sb_case_file_path(const struct sb_case_file *file);
void sb_case_file_close(struct sb_case_file **file);
