#include <signal.h>
#include <stddef.h>

#include "measure/interrupt.h"

// A signal handler can reach nothing else: the one flag of the program.
static volatile sig_atomic_t caught;

static void on_signal(int number)
{
    (void)number;
    caught = 1;
}

void sb_interrupt_install(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
}

bool sb_interrupted(void)
{
    return caught;
}
