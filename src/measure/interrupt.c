#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"
#include "measure/interrupt.h"

static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNAL_COUNT = sizeof signals / sizeof *signals };

#define LIFELINE "SB_LIFELINE"

// A signal handler can reach nothing else: the only variables of the program that change.
static atomic_int caught;
static atomic_int told = -1; // the end of a life line that is written to; -1: none

static void tell(void)
{
    const ssize_t ignored = told >= 0 ? write(told, "", 1) : 0;
    (void)ignored; // nobody is there any more
}

static void on_signal(int number)
{
    const int cause = errno;
    (void)number;
    caught = 1;
    tell();
    errno = cause;
}

static void set_mask(int how)
{
    sigset_t set;
    sigemptyset(&set);
    for (int i = 0; i < SIGNAL_COUNT; i++)
        sigaddset(&set, signals[i]);
    sigprocmask(how, &set, NULL);
}

// --- the end of one who was started ----------------------------------------------------------

// What is written is never read, so that the next program image finds it, too.
static void *watch(void *descriptor)
{
    struct pollfd one = {.fd = *(const int *)descriptor, .events = POLLIN};
    while (poll(&one, 1, -1) < 1)
        continue;
    caught = 1;
    return NULL;
}

static void start_watch(void)
{
    static int descriptor; // the watch outlives this function
    const char *text = getenv(LIFELINE);
    struct stat about;
    double number;
    pthread_t thread;
    sigset_t all, before;
    if (!text || !sb_parse_number(text, &number) || number < 3 || number > 1 << 20 ||
        fstat((int)number, &about) != 0 || !S_ISFIFO(about.st_mode))
        return;
    descriptor = (int)number;
    // Signals are the main thread's: they interrupt what it waits for.
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    if (pthread_create(&thread, NULL, watch, &descriptor) == 0)
        pthread_detach(thread);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

// --- the end of one who starts them ----------------------------------------------------------

bool sb_lifeline_open(struct sb_lifeline *line, struct sb_error *err)
{
    if (pipe(line->ends) != 0)
        return sb_fail(err, SB_INTERNAL, "pipe: %s", strerror(errno));
    // They inherit the end that is read, and must not hold the other.
    fcntl(line->ends[1], F_SETFD, FD_CLOEXEC);
    snprintf(line->setting, sizeof line->setting, LIFELINE "=%d", line->ends[0]);
    told = line->ends[1];
    if (caught) // before there was one to tell
        tell();
    return true;
}

void sb_lifeline_close(struct sb_lifeline *line)
{
    told = -1;
    close(line->ends[0]);
    close(line->ends[1]);
}

// --- signals ---------------------------------------------------------------------------------

void sb_interrupt_install(void)
{
    for (int i = 0; i < SIGNAL_COUNT; i++) {
        struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESETHAND};
        struct sigaction earlier;
        sigemptyset(&action.sa_mask);
        if (sigaction(signals[i], NULL, &earlier) == 0 && earlier.sa_handler != SIG_IGN)
            sigaction(signals[i], &action, NULL);
    }
    start_watch();
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
