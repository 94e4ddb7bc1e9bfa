// What the program of a worker is: its descriptors, its end, and the conversation.
#pragma once

#include "job/job.h"

// Standard input and output become private to the conversation, and what drivers print goes to
// stderr; SIGINT is ignored, since shadebench ends its workers; should whoever asks vanish, this
// process ends even while a driver hangs. Returns the exit code.
int sb_worker_main(const struct sb_runner_fns *(*runner)(const struct sb_context_params *,
                                                         struct sb_error *err));
