// A worker that draws nothing and goes wrong on demand. FAULT=what@call[:job]: what it does when it
// is asked for that call (of that job, where one is named). ONCE=FILE: only if there is no such
// file, which it makes. AFTER=N: not at the first N of these calls. OTHER_DRIVER=FILE, NO_TIMER=FILE:
// where there is such a file, which the first worker makes, it names another driver, and refuses
// the timer.
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/mem.h"
#include "job/null.h"
#include "wire/worker_main.h"

static int protocol; // the descriptor that answers go to
static struct sb_runner_fns faulty;

static void run_out_of_memory(void)
{
    const struct rlimit limit = {.rlim_cur = 64 << 20, .rlim_max = 64 << 20};
    setrlimit(RLIMIT_AS, &limit);
    for (;;)
        memset(sb_alloc(1 << 20), 1, 1 << 20);
}

static void do_fault(const char *what)
{
    static const char noise[] = "Segmentation fault is what I would never print";
    if (strncmp(what, "segv", 4) == 0)
        signal(SIGSEGV, SIG_DFL), raise(SIGSEGV);
    else if (strncmp(what, "abort", 5) == 0)
        signal(SIGABRT, SIG_DFL), abort();
    else if (strncmp(what, "exit", 4) == 0)
        _exit(7);
    else if (strncmp(what, "hang", 4) == 0)
        for (;;)
            pause();
    else if (strncmp(what, "stop", 4) == 0)
        raise(SIGSTOP);
    else if (strncmp(what, "garbage", 7) == 0)
        (void)!write(protocol, noise, sizeof noise);
    else if (strncmp(what, "memory", 6) == 0)
        run_out_of_memory();
    else if (strncmp(what, "slow", 4) == 0)
        sleep(3); // longer than a worker lives whose other end has vanished
    else if (strncmp(what, "print", 5) == 0) {
        printf("%s\n", noise);
        fflush(stdout);
    }
}

static void maybe(const char *call, uint32_t job)
{
    static int calls;
    const char *fault = getenv("FAULT"), *once = getenv("ONCE"), *after = getenv("AFTER");
    const char *at = fault ? strchr(fault, '@') : NULL;
    if (!at || strncmp(at + 1, call, strlen(call)) != 0)
        return;
    const char *colon = strchr(at, ':');
    if (colon && strtoul(colon + 1, NULL, 10) != job)
        return;
    if (after && ++calls <= atoi(after))
        return;
    if (once && open(once, O_CREAT | O_EXCL | O_WRONLY, 0600) < 0)
        return;
    do_fault(fault);
}

static bool is_made(const char *variable)
{
    const char *mark = getenv(variable);
    return mark && open(mark, O_CREAT | O_EXCL | O_WRONLY, 0600) < 0;
}

static void *open_faulty(const struct sb_context_params *params, struct sb_caps *caps,
                         struct sb_error *err)
{
    maybe("open", 0);
    void *self = sb_runner_null.open(params, caps, err);
    if (is_made("OTHER_DRIVER"))
        snprintf(caps->renderer, sizeof caps->renderer, "another");
    return self;
}

static bool use_timer_faulty(void *self, int source, struct sb_error *err)
{
    return is_made("NO_TIMER") ? sb_fail(err, SB_GL_ERROR, "there is no such timer")
                               : sb_runner_null.use_timer(self, source, err);
}

static void close_faulty(void *self)
{
    maybe("close", 0);
    sb_runner_null.close(self);
}

static bool prepare_faulty(void *self, const struct sb_job *job,
                           struct sb_prepared *prepared)
{
    maybe("prepare", job->id);
    return sb_runner_null.prepare(self, job, prepared);
}

static bool round_faulty(void *self, const struct sb_shot *shots, int count,
                         struct sb_sample *samples, struct sb_error *err)
{
    maybe("round", shots[0].job);
    return sb_runner_null.round(self, shots, count, samples, err);
}

static bool image_faulty(void *self, const struct sb_image_request *request,
                         struct sb_image *image, struct sb_error *err)
{
    maybe("image", request->job);
    return sb_runner_null.image(self, request, image, err);
}

static const struct sb_runner_fns *pick_runner(const struct sb_context_params *params,
                                               struct sb_error *err)
{
    (void)params, (void)err;
    return &faulty;
}

int main(void)
{
    protocol = fcntl(1, F_DUPFD, 64);
    faulty = sb_runner_null;
    faulty.open = open_faulty;
    faulty.use_timer = use_timer_faulty;
    faulty.prepare = prepare_faulty;
    faulty.round = round_faulty;
    faulty.image = image_faulty;
    faulty.close = close_faulty;
    return sb_worker_main(pick_runner);
}
