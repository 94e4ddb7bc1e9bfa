// What a history says: series of ratios over commits, the levels that each has had, and how far it
// has crept from its first.
#pragma once

#include "results/history_row.h"
#include "stats/change_points.h"

struct sb_history_point { // a commit
    const char *commit;
    const char *time; // of its first row
    double ratio;     // median over its rows
    int rows;
};

// Rows of one scene, variant, metric, driver (renderer, version, threads) and anchor: those that may
// be held against each other.
struct sb_history_series {
    const struct sb_history_row *like; // the last of them, for what they have in common
    struct sb_history_point *point;    // by time
    int point_count;
    int rows;   // that have a ratio
    int failed; // that have none
    int unread; // points before the last SB_CHANGE_VALUES_MAX: they are not in `point`
    struct sb_segment *segment;
    int segment_count;
    double
        creep;  // level of the last segment over that of the first, less 1; NAN: no point
    bool crept; // by more than the tolerance, upwards
    bool recent; // the level went up among the last `recent` commits
};

struct sb_history_params {
    const struct sb_history_row
        *row; // in the order of the file; outlives what is made of it
    int count;
    const char *pattern; // of variants, or of scene/variant, as fnmatch has it; NULL: all
    // By how much neighbouring levels differ at least, and what is no creep; in [0, 1).
    double tolerance;
    int recent; // commits
};

struct sb_history_analysis {
    struct sb_history_series *series; // in the order of their first rows
    int count;
};

// Do the rows differ in nothing but scene and variant, so that their series make one table?
bool sb_history_together(const struct sb_history_row *a, const struct sb_history_row *b);

// Series of all rows that the pattern wants. *analysis must be zeroed.
void sb_history_analyse(const struct sb_history_params *params,
                        struct sb_history_analysis *analysis);
void sb_history_analysis_free(struct sb_history_analysis *analysis);
