// Made-up histories: rows of one driver, anchor and variant, which a test changes.
#pragma once

#include "test.h"

#include "results/history_row.h"

enum { HISTORY_ROWS = 4096 };
static struct sb_history_row history_row[HISTORY_ROWS];
static char history_text[HISTORY_ROWS][2][32]; // time and commit
static int history_count;

// Appends a row: commit `number` (c000, c001 …), of a day each, and its ratio.
static inline struct sb_history_row *add_ratio(int number, double ratio)
{
    assert_true(history_count < HISTORY_ROWS);
    char *time = history_text[history_count][0], *commit = history_text[history_count][1];
    snprintf(time, 32, "%04u-%02u-%02uT00:00:00Z", 2026u + (unsigned)number / 336 % 100,
             (unsigned)number / 28 % 12 + 1, (unsigned)number % 28 + 1);
    snprintf(commit, 32, "c%03d", number);
    struct sb_history_row *row = &history_row[history_count++];
    sb_history_row_init(row);
    row->time = time;
    row->commit = commit;
    row->suite = "ci";
    row->scene = "containers";
    row->variant = "point=4,stage=fragment";
    row->metric = "cpu";
    row->anchor = "00000000000000aa";
    row->renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    row->version = "4.5 Mesa 22.3.6";
    row->threads = "1";
    row->ratio = ratio;
    row->ratio_lo = 0.99 * ratio;
    row->ratio_hi = 1.01 * ratio;
    row->processes = 3;
    row->pairs = 60;
    row->source_hash = "0123456789abcdef";
    row->status = "ok";
    return row;
}
