// Absolute budgets: what a suite expects of columns of summary.csv (`expect:`), and whether the rows
// of a run keep it. Pure: whoever calls prints, writes and decides the exit code.
#pragma once

#include "base/mem.h"
#include "results/row.h"
#include "suite/suite.h"

enum sb_relation {
    SB_AT_MOST,
    SB_AT_LEAST,
    SB_LESS,
    SB_MORE,
    SB_EQUAL,
    SB_RELATION_COUNT
};
struct sb_expect_rule {
    const struct sb_expectation *expectation;
    const struct sb_column *column; // a column of text has SB_EQUAL and a word
    enum sb_relation relation;
    double limit;
    const char *word; // the bound without its relation, as written
};

enum sb_expect_verdict {
    SB_EXPECT_HELD,
    SB_EXPECT_MISSED,
    SB_EXPECT_INCONCLUSIVE,
    SB_EXPECT_VERDICT_COUNT
};
extern const char *const sb_expect_words[SB_EXPECT_VERDICT_COUNT];

struct sb_expect_finding { // of a rule and a row
    const struct sb_expect_rule *rule;
    const struct sb_row *row; // NULL: the rule names no row, and is missed
    enum sb_expect_verdict verdict;
    const char *measured; // in words: "4.1 (3.9 … 4.3)"
};

struct sb_expected {
    struct sb_expect_rule *rule;
    int rule_count;
    struct sb_expect_finding *finding; // of sb_expect_check
    int finding_count, of[SB_EXPECT_VERDICT_COUNT];
    struct sb_arena arena;
};

// Reads columns and bounds: `<= 4`, `>= 30`, `< 2/255`, `> 0`, `= 0` or `0`, and of a column of text a
// word. SB_BAD_INPUT at file:line:column for a column that summary.csv has not, a bound that is
// none, and for = on a column with an interval. *expected must be zeroed; free also after
// failure. The suite is borrowed.
bool sb_expect_resolve(const struct sb_suite *suite, struct sb_expected *expected,
                       struct sb_error *err);

// Judges each rule on each row that it names, rule after rule. Rows are borrowed, on the axes of the
// suite. A value that has an interval is held by it: <= holds where all of the interval does, is
// missed where none of it does, and is inconclusive else, or where there is no interval. Missed
// are also rules that name no row, values that were not measured, and rows whose status fails
// the run, but for what is expected of `status` itself.
void sb_expect_check(struct sb_expected *expected, const struct sb_row *row, int count);
void sb_expect_free(struct sb_expected *expected);

// `max_err <= 2/255` and `max_err <= 2/255 of containers point=8: 0.034 (ci.yaml:14:14)`.
void sb_expect_rule_text(const struct sb_expect_rule *rule, struct sb_text *text);
void sb_expect_text(const struct sb_expect_finding *finding, struct sb_text *text);
