// run --check: what the suite expects of its rows.
#pragma once

#include "analyse/expect.h"
#include "cli/common.h"
#include "export/from_results.h"

// Reads the suite's `expect:` before anything is measured, so that a slip in it is told at once, and
// with or without --check. SB_USAGE where --check has nothing to judge. *expected must be
// zeroed; sb_expect_free also after failure.
bool sb_cli_expect(const struct sb_options *options, const struct sb_suite *suite,
                   struct sb_expected *expected, struct sb_error *err);

// Once judged: a count, and a line for each that is missed or inconclusive.
void sb_cli_expect_print(const struct sb_expected *expected);
json_t *sb_cli_expect_json(const struct sb_expected *expected);

// The same in the rows that other programs read, which are those of `row`, in its order: a budget
// that was missed fails its row, one that cannot be decided is not passed. A row that had failed
// by itself keeps its status. A rule that names no row becomes one.
void sb_cli_expect_export(const struct sb_expected *expected, const struct sb_row *row,
                          struct sb_exported *exported);

// 1 where one is missed; 4 where one is inconclusive and that is to fail; else 0.
int sb_cli_expect_code(const struct sb_options *options,
                       const struct sb_expected *expected);
