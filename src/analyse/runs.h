// Two runs side by side: what each row of B takes over the same row of A, as shader-db tells it
// (helped, hurt, lost, gained). The runs were other processes, so no sample has a partner; see
// stats/unpaired.h for what the intervals cover.
#pragma once

#include "base/mem.h"
#include "results/row.h"
#include "stats/order.h"

enum sb_run_verdict {
    SB_RUN_HELPED,    // the ratio's interval lies below the tolerance,
    SB_RUN_HURT,      // above it,
    SB_RUN_UNCHANGED, // inside it,
    SB_RUN_UNCLEAR,   // or across one of its ends; or there is none
    SB_RUN_UNTIMED,   // neither has a time
    SB_RUN_LOST,      // A has a time, B has none, or no such row
    SB_RUN_GAINED,    // the other way round
    SB_RUN_REFUSED,   // measured under other conditions
    SB_RUN_VERDICT_COUNT
};
struct sb_run_verdict_row {
    const char *word, *help;
};
extern const struct sb_run_verdict_row sb_run_verdict_rows[SB_RUN_VERDICT_COUNT];

// What is known of a run besides its rows: machine and environment. Names differ.
struct sb_run_fact {
    const char *name, *value;
};

struct sb_run_side {
    const struct sb_axes *axes;
    const struct sb_row *row;
    int count;
    const struct sb_run_fact *fact;
    int fact_count; // 0: nothing is known, and nothing refused for it
};

struct sb_runs_params {
    struct sb_run_side a, b;
    double tolerance; // a share: 0.02
    bool force;       // judge, and mark, what would be refused
};

enum sb_run_change { SB_RUN_BETTER = -1, SB_RUN_SAME, SB_RUN_WORSE };
enum sb_run_code { SB_RUN_CODE_UNKNOWN, SB_RUN_CODE_SAME, SB_RUN_CODE_CHANGED };

struct sb_run_pair {
    const struct sb_row *a, *b; // NULL: it has no such row
    enum sb_run_verdict verdict;
    struct sb_interval ratio; // frame time of b over that of a; NAN where it is not known
    bool between; // the interval is between processes, else within one of each
    // B against A. Errors: max_err by more than the tolerance, or nonfinite at all; SAME where
    // one has none. Status: what its exit code says.
    enum sb_run_change error, status;
    enum sb_run_code source, binary;
    const char *differs; // conditions and axes that differ: "width 64 | 128"; "" for none
    bool unlike;         // such that the two do not compare
};

struct sb_runs {
    struct sb_run_pair *pair; // A's rows in order, then those of B that A has not
    int count, of[SB_RUN_VERDICT_COUNT];
    int comparable; // pairs that were not refused
    int within;     // of those, pairs with a ratio within one process a side,
    int between;    // and with one between processes
    int worse; // pairs that are hurt, worse in error or status, or lost by a sound row
    int moved; // of those, pairs that are helped or hurt with the same source
    struct sb_arena arena;
};

// Rows are the same where scene and id are. What is left over is matched by the values of all axes,
// but for those (and the scene) that all rows of A have with one value and all of B with another:
// so a run on another driver, or of another size, is refused row by row, and not lost.
// Refused are pairs of another scene, renderer, version, timer source, input hash, of another value
// on an axis that sb_pareto_keeps_apart, or of runs with other facts. On an axis a row that failed may
// say `auto`, which is no difference; a run that lacks an axis differs from every value. Rows are
// borrowed.
// *runs must be zeroed.
void sb_runs_compare(const struct sb_runs_params *params, struct sb_runs *runs);
void sb_runs_free(struct sb_runs *runs);
