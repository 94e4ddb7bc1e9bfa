// The in-process runner: opens a context in this process and draws in it. One at a time
// in a process, from one thread.
#pragma once

#include "job/job.h"

extern const struct sb_runner_fns sb_runner_local;
