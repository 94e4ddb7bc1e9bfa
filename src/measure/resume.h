// Going on with a results folder: what it holds must be of the same plan and driver.
#pragma once

#include <jansson.h>

#include "measure/task.h"
#include "results/csv.h"

struct sb_earlier {
    json_t *run; // run.json
    struct sb_csv samples;
    int process;          // number of the next process
    int complete;         // processes that were complete
    bool last_incomplete; // the last one was interrupted: only what it lacks is measured,
    int first_open;     // with what it and the interrupted ones before it, from this one,
                        // measured
    double timer_error; // the largest of its processes, in their audits; 0: none
    const char *timer;  // that the samples were timed with; NULL: no samples
    struct sb_csv summary; // after sb_earlier_recall
};

// SB_BAD_INPUT where the folder's plan is not this one. *earlier must be zeroed; free also
// after failure.
bool sb_earlier_load(const char *dir, const struct sb_suite *suite,
                     struct sb_earlier *earlier, struct sb_error *err);

// Is this the driver that the folder was measured on?
bool sb_earlier_check_driver(const struct sb_earlier *earlier, const struct sb_caps *caps,
                             struct sb_error *err);

// Are the programs and what they draw those that the folder was measured with? Asked once
// the tasks are prepared; another shader or scene would be averaged with the first.
bool sb_earlier_check_sources(const struct sb_earlier *earlier,
                              const struct sb_task *tasks, int count,
                              struct sb_error *err);

// Hands the samples to their tasks, with the batch length they were measured with.
bool sb_earlier_hand_out(const struct sb_earlier *earlier, struct sb_task *tasks,
                         int count, struct sb_error *err);

// The rows of summary.csv, for a folder that lacks nothing: no driver is opened. Their texts
// live in `earlier`, their axes in `variants`; both have one item a plan entry.
bool sb_earlier_recall(struct sb_earlier *earlier, const char *dir,
                       const struct sb_suite *suite, struct sb_row *rows,
                       struct sb_variant *variants, struct sb_error *err);
void sb_earlier_free(struct sb_earlier *earlier);
