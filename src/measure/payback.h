// Does it add up? The frames after which a policy has paid for its programs, drawn.
#pragma once

#include "measure/task.h"

struct sb_payback_params {
    struct sb_task *task;
    int task_count;
    const struct sb_row *row; // summarised, one a task
    const struct sb_driver *driver;
};

// For each row with a finite payback_frames: both its programs and those of the uber row it is held
// against are made anew and draw that many frames; task->payback_check is the one total over the
// other. Rows of which that would take more than 20 s are left out, and say so.
void sb_payback_check(const struct sb_payback_params *params);
