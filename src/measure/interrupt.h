// Ctrl-C and SIGTERM: finish the round, keep what was measured, end with 130. A second
// signal ends the process at once.
#pragma once

#include <stdbool.h>

void sb_interrupt_install(void);
bool sb_interrupted(void);
