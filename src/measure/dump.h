// What a variant draws and what it is drawn from, as files that another program can check it
// by: float picture, ids, and the scene with every float that is uploaded. docs/formats.md
// has the format.
#pragma once

#include "measure/task.h"

// Into dir/SCENE-ID/, which is made. The task must be loaded. SB_WRITE_FAILED or SB_BAD_INPUT
// name the file; the runner's own failures are passed on.
bool sb_dump(const struct sb_task *task, const struct sb_driver *driver,
             const struct sb_axes *axes, const char *dir, struct sb_error *err);
