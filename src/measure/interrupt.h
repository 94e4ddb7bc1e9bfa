// Ctrl-C and SIGTERM: finish the round, keep what was measured, end with 130. A second
// signal ends the process at once.
#pragma once

#include <stdbool.h>

// Signals that the process was started to ignore (nohup, a shell's background job) stay
// ignored. Also ends a hold that the process was started under.
void sb_interrupt_install(void);

// Holds the signals back, so that none is lost between asking sb_interrupted and execv: the
// next program image takes them up.
void sb_interrupt_hold(void);
bool sb_interrupted(void);
