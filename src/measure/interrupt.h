// Ctrl-C and SIGTERM: finish the round, keep what was measured, end with 130. A second
// signal ends the process at once.
#pragma once

#include <stdbool.h>

#include "base/error.h"

// Signals that the process was started to ignore (nohup, a shell's background job) stay
// ignored. Also ends a hold that the process was started under, and watches the life line that it was
// started with.
void sb_interrupt_install(void);

// Holds the signals back, so that none is lost between asking sb_interrupted and execv: the
// next program image takes them up.
void sb_interrupt_hold(void);
bool sb_interrupted(void);

// A pipe to the runs that this process starts and waits for. Told to stop, it tells them; and where it
// ends without a word, they end in good order, too. Signals could do neither: a terminal sends
// its own to all of them, and of one that came twice a process ends at once.
struct sb_lifeline {
    int ends[2];
    char setting[32]; // for their environment: sb_process_params
};
// One at a time. SB_INTERNAL
bool sb_lifeline_open(struct sb_lifeline *line, struct sb_error *err);
void sb_lifeline_close(struct sb_lifeline *line);
