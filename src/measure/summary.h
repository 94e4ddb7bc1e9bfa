// From tasks and their samples to the rows of summary.csv: estimates only, nothing is measured.
#pragma once

#include "measure/task.h"

struct sb_summary_params {
    const struct sb_task *task;
    int task_count;
    const struct sb_driver *driver;
    const struct sb_suite *suite;
    double timer_error; // of earlier processes; the row has the largest of all
};

// Fills row[0 .. task_count - 1]; texts live in `arena` or in the tasks.
void sb_summarise(const struct sb_summary_params *params, struct sb_row *row,
                  struct sb_arena *arena);
