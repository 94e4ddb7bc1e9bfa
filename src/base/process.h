// Another program, run to its end.
#pragma once

#include "base/error.h"
#include "base/text.h"

// Where one of its two output streams goes.
enum sb_stream { SB_STREAM_KEPT, SB_STREAM_DROPPED, SB_STREAM_TAKEN };

struct sb_process_params {
    const char *const *words;       // ends with NULL; the first is looked for in PATH
    const char *const *environment; // what differs from ours: sb_environment_with
    int environment_count;
    enum sb_stream output, errors; // TAKEN: one of them at most
    struct sb_text *text;          // what was taken is added here
};

// False: it could not be started (SB_USAGE), or a signal ended it (SB_WORKER_CRASHED). What it
// meant by its exit code is the caller's to say.
bool sb_process_run(const struct sb_process_params *params, int *exit_code,
                    struct sb_error *err);
