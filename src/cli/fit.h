// What `fit` says, and its two ways of saying it.
#pragma once

#include "analyse/crossing.h"
#include "analyse/fit.h"
#include "cli/compare.h"

enum { SB_BUDGETS_MAX = 16 };

struct sb_fit_report {
    const struct sb_compared *compared;
    struct sb_fit fit;
    struct sb_crossings crossings;
    double ms[SB_BUDGETS_MAX]; // asked for, ascending
    int ms_count;              // 0: each group has its own
};

// The frame times of a group's table: those asked for, else the powers of two from the fastest
// row to the first above the slowest, the largest six. Returns their number, at most
// SB_BUDGETS_MAX.
int sb_fit_budgets(const struct sb_fit_report *report, const struct sb_fit_group *group,
                   double *ms);

// The scene, and those axes of the row that the groups or series have in other words.
void sb_fit_heading(const struct sb_fit_report *report, const struct sb_fit_group *group,
                    struct sb_text *text);
void sb_fit_series_heading(const struct sb_fit_report *report,
                           const struct sb_crossing_series *series, struct sb_text *text);

// "dir=2 point=3": the counts that are above the group's lowest.
void sb_fit_mix_text(const struct sb_fit_report *report, const struct sb_fit_group *group,
                     const struct sb_row *row, struct sb_text *text);

void sb_fit_print(const struct sb_fit_report *report); // to stdout
json_t *sb_fit_json(const struct sb_fit_report *report);
