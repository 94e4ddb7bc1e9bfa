// The rounds of one process: every active task once a round, in seeded random order; looks at
// the intervals when they are due; a variant stops when it is precise enough.
#pragma once

#include "measure/task.h"
#include "results/store.h"
#include "stats/looks.h"

struct sb_rounds {
    struct sb_task *task;
    int task_count;
    const struct sb_driver *driver;
    const struct sb_measure_settings *settings;
    int process; // number of this process, for the rows
    struct sb_store *store;
    // Called after each round, with the seconds that measuring may still take. May be NULL.
    void (*after_round)(void *user, int rounds, int active, double seconds_left);
    void *user;
};

// Runs until no task is active, the budget or the rounds are used up, or a signal came;
// tasks that were still active say so in `stop`. False when the results could not be written:
// then the tasks still hold what was measured. A round that fails fails its tasks.
bool sb_rounds_run(struct sb_rounds *rounds, struct sb_error *err);

struct sb_looks sb_looks_of(const struct sb_measure_settings *settings);

// Did the samples of this process satisfy the stopping rule at one of its looks?
bool sb_task_precise(const struct sb_task *task, int process,
                     const struct sb_measure_settings *settings);
