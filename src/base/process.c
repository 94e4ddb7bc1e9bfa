#include "base/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/environment.h"
#include "base/mem.h"

static void route(posix_spawn_file_actions_t *actions, enum sb_stream stream, int fd,
                  int writing)
{
    if (stream == SB_STREAM_DROPPED)
        posix_spawn_file_actions_addopen(actions, fd, "/dev/null", O_WRONLY, 0);
    else if (stream == SB_STREAM_TAKEN)
        posix_spawn_file_actions_adddup2(actions, writing, fd);
}

// `ends`: of the pipe, or -1.
static bool start(const struct sb_process_params *params, const int ends[2], pid_t *child,
                  struct sb_error *err)
{
    struct sb_arena arena = {0};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t pipe_signal;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE); // ignored here (cli/main.c); programs expect it
    posix_spawnattr_setsigdefault(&attributes, &pipe_signal);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    route(&actions, params->output, STDOUT_FILENO, ends[1]);
    route(&actions, params->errors, STDERR_FILENO, ends[1]);
    char **environment =
        sb_environment_with(params->environment, params->environment_count, &arena);
    fflush(NULL); // what was said before it comes before what it says
    const int cause = posix_spawnp(child, params->words[0], &actions, &attributes,
                                   (char *const *)params->words, environment);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    sb_arena_free(&arena);
    return cause == 0 ||
           sb_fail(err, SB_USAGE, "%s: %s", params->words[0], strerror(cause));
}

// A read that fails ends it, as the end does: the program then finds a closed pipe.
static void take(int fd, struct sb_text *text)
{
    char chunk[4096];
    for (;;) {
        const ssize_t count = read(fd, chunk, sizeof chunk);
        if (count > 0)
            sb_text_add_n(text, chunk, (size_t)count);
        else if (count == 0 || errno != EINTR)
            return;
    }
}

bool sb_process_run(const struct sb_process_params *params, int *exit_code,
                    struct sb_error *err)
{
    int ends[2] = {-1, -1}, status = 0;
    pid_t child;
    const bool taken =
        params->output == SB_STREAM_TAKEN || params->errors == SB_STREAM_TAKEN;
    if (taken && pipe(ends) != 0)
        return sb_fail(err, SB_INTERNAL, "pipe: %s", strerror(errno));
    for (int i = 0; taken && i < 2; i++)
        fcntl(ends[i], F_SETFD, FD_CLOEXEC); // adddup2 gives the child one without
    const bool started = start(params, ends, &child, err);
    if (taken) {
        close(ends[1]);
        if (started)
            take(ends[0], params->text);
        close(ends[0]);
    }
    if (!started)
        return false;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            return sb_fail(err, SB_INTERNAL, "%s: %s", params->words[0], strerror(errno));
    if (!WIFEXITED(status))
        return sb_fail(err, SB_WORKER_CRASHED, "%s was killed by signal %d",
                       params->words[0], WTERMSIG(status));
    *exit_code = WEXITSTATUS(status);
    return true;
}
