#include "wire/child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/environment.h"
#include "base/log.h"

enum { KILLED_S = 5 }; // within which a process that was killed should be gone

// Between fork and exec: only what is safe there, but for the environment, which is this
// process's own copy; shadebench has one thread whenever it starts a worker.
static void become(const struct sb_child_params *params, int fd)
{
    setpgid(0, 0);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    signal(SIGPIPE, SIG_DFL); // ignored here (cli/main.c), it would be in every command
    sb_environment_apply(params->environment, params->environment_count);
    if (dup2(fd, 0) < 0 || dup2(fd, 1) < 0)
        _exit(126);
    // The shell becomes the command where it is a simple one, so that signals reach it.
    execl("/bin/sh", "sh", "-c", params->command, (char *)NULL);
    _exit(127);
}

bool sb_child_start(const struct sb_child_params *params, struct sb_child *child,
                    struct sb_error *err)
{
    int pair[2];
    *child = (struct sb_child){.fd = -1};
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0)
        return sb_fail(err, SB_INTERNAL, "no worker can be started: %s", strerror(errno));
    fcntl(pair[0], F_SETFD, FD_CLOEXEC); // no later child may hold this one's life line
    fcntl(pair[1], F_SETFD, FD_CLOEXEC);
    const pid_t pid = fork();
    if (pid == 0)
        become(params, pair[1]);
    close(pair[1]);
    if (pid < 0) {
        close(pair[0]);
        return sb_fail(err, SB_INTERNAL, "no worker can be started: %s", strerror(errno));
    }
    setpgid(pid, pid); // on both sides: whoever comes first
    *child = (struct sb_child){.pid = pid, .fd = pair[0]};
    return true;
}

static void tell(int status, struct sb_text *how)
{
    static const struct {
        int number;
        const char *name;
    } names[] = {{SIGSEGV, "SIGSEGV"},
                 {SIGABRT, "SIGABRT"},
                 {SIGBUS, "SIGBUS"},
                 {SIGFPE, "SIGFPE"},
                 {SIGILL, "SIGILL"},
                 {SIGTERM, "SIGTERM"},
                 {SIGKILL, "SIGKILL, by hand or for want of memory"}};
    // What a shell says of a command that a signal has ended.
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    const int number = WIFSIGNALED(status)             ? WTERMSIG(status)
                       : code > 128 && code < 128 + 32 ? code - 128
                                                       : 0;
    if (number == 0) {
        sb_text_printf(how, "ended with exit code %d%s", code,
                       code == 127   ? ": there is no such command"
                       : code == 126 ? ": the command cannot be run"
                                     : "");
        return;
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].number == number) {
            sb_text_printf(how, "was killed by %s", names[i].name);
            return;
        }
    sb_text_printf(how, "was killed by signal %d", number);
}

enum wait_end { ENDED, RUNS, UNKNOWN };

static enum wait_end wait_for(pid_t pid, double seconds, int *status)
{
    const int64_t deadline = sb_clock_ns() + (int64_t)(seconds * 1e9);
    for (;;) {
        const pid_t ended = waitpid(pid, status, WNOHANG);
        if (ended == pid)
            return ENDED;
        if (ended < 0 && errno != EINTR)
            return UNKNOWN;
        if (sb_clock_ns() >= deadline)
            return RUNS;
        sb_sleep_ns(1000000);
    }
}

void sb_child_end(struct sb_child *child, double seconds, struct sb_text *how)
{
    int status = 0;
    if (child->pid <= 0)
        return;
    close(child->fd);
    const enum wait_end end = wait_for(child->pid, seconds, &status);
    kill(-child->pid, SIGKILL); // what it has started, too
    if (end == ENDED)
        tell(status, how);
    // A process in the midst of a system call that cannot be interrupted, as a GPU's driver may
    // be, outlives even that. Whoever waits for it hangs, too.
    if (end == RUNS && wait_for(child->pid, KILLED_S, &status) == RUNS)
        sb_warn("process %d hangs in the kernel and cannot be killed; it is left behind",
                (int)child->pid);
    *child = (struct sb_child){.fd = -1};
}
