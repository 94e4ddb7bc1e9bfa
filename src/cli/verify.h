// What the parts of `verify` share: the hard cases from the command line to the report.
#pragma once

#include "cases/price.h"
#include "cases/search.h"
#include "cli/common.h"
#include "results/row.h"

// verify without --classes; the exit code.
int sb_cli_verify_cases(const struct sb_options *options, int argc, char **argv,
                        const char *data, struct sb_error *err);

// What was found in one precision; `params` are those that it was searched with.
struct sb_cli_searched {
    struct sb_search_params params;
    struct sb_findings findings;
};

struct sb_verify {
    const struct sb_options *options;
    // asked
    const struct sb_case *it[SB_CASES_MAX];
    int case_count;
    unsigned forms, precisions; // as in struct sb_matrix_params
    double seconds;             // of searching; 0: none
    double seed;
    // where
    const char *data, *dir;
    struct sb_suite platform; // of the platform axes, one entry
    struct sb_driver driver;
    struct sb_case_env env;
    struct sb_crew *crew; // other processes that ask cells; NULL: none
    // answers
    struct sb_matrix matrix;
    struct sb_cli_searched searched[SB_CASE_PRECISION_COUNT];
    int searched_count;
    struct sb_prices prices;
    bool priced; // prices were measured
    int code;    // worst so far
    struct sb_arena arena;
};

// --- verify_files.c: cases.csv, junit.xml, JSON -------------------------------------------

// The row of a cell; its texts live in `arena`, the cell and the tables.
void sb_verify_row(const struct sb_verify *verify, const struct sb_matrix_cell *cell,
                   struct sb_arena *arena, struct sb_case_row *row);
bool sb_verify_write_junit(struct sb_verify *verify, struct sb_error *err);
json_t *sb_verify_json(struct sb_verify *verify);

// --- verify_report.c: text on stdout ------------------------------------------------------

void sb_verify_print(struct sb_verify *verify);
