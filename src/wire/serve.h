// The worker's side of the conversation: a runner, asked over a pipe.
#pragma once

#include <stdatomic.h>

#include "job/job.h"

struct sb_serve_params {
    int in, out; // descriptors
    // The runner for a kind of context, or NULL with *err.
    const struct sb_runner_fns *(*runner)(const struct sb_context_params *,
                                          struct sb_error *err);
    atomic_bool *closing; // set once `close` was asked; NULL: nobody wants to know
};

// Answers until `close` is asked or `in` ends; then the runner is closed. 0, or the exit code that
// belongs to what went wrong: what came is no request, or nobody reads the answers.
int sb_serve(const struct sb_serve_params *params);
