// The file of a history: a CSV with one header that only grows, by whole rows, whoever writes.
#pragma once

#include "base/error.h"
#include "results/csv.h"
#include "results/history_row.h"

// Appends rows behind those that are there, all of them or none, and the header before the first.
// The file is locked meanwhile (fcntl), so writers come one after another. With `count` 0 the
// file is made, or looked at: can rows be appended?
//
// SB_BAD_INPUT: no regular file, one that cannot be opened, or one with another header.
// SB_WRITE_FAILED: the rows do not fit; what was there before is whole. Of a last line without its
// end, which a writer left that was killed, nothing stays: it never was a row.
bool sb_history_append(const char *path, const struct sb_history_row *rows, int count,
                       struct sb_error *err);

struct sb_history {
    struct sb_history_row *row; // row[i] stands in line i + 2
    int count;
    struct sb_csv csv; // owns the texts
};

// Reads a history; a last line without its end is left out. SB_BAD_INPUT with file:line for
// another header, a cell that is none of its column, a row that names no commit, scene, variant or
// time, and a row that is ok and has no ratio. *history must be zeroed; free also after failure.
bool sb_history_read(const char *path, struct sb_history *history, struct sb_error *err);
void sb_history_free(struct sb_history *history);
