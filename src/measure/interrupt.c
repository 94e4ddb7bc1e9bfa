#include <signal.h>
#include <stddef.h>

#include "measure/interrupt.h"

static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNAL_COUNT = sizeof signals / sizeof *signals };

// A signal handler can reach nothing else: the one flag of the program.
static volatile sig_atomic_t caught;

static void on_signal(int number)
{
    (void)number;
    caught = 1;
}

static void set_mask(int how)
{
    sigset_t set;
    sigemptyset(&set);
    for (int i = 0; i < SIGNAL_COUNT; i++)
        sigaddset(&set, signals[i]);
    sigprocmask(how, &set, NULL);
}

void sb_interrupt_install(void)
{
    for (int i = 0; i < SIGNAL_COUNT; i++) {
        struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESETHAND};
        struct sigaction earlier;
        sigemptyset(&action.sa_mask);
        if (sigaction(signals[i], NULL, &earlier) == 0 && earlier.sa_handler != SIG_IGN)
            sigaction(signals[i], &action, NULL);
    }
    set_mask(SIG_UNBLOCK);
}

void sb_interrupt_hold(void)
{
    set_mask(SIG_BLOCK);
}

bool sb_interrupted(void)
{
    return caught;
}
