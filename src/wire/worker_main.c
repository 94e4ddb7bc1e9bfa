#include "wire/worker_main.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <unistd.h>

#include "base/log.h"
#include "wire/serve.h"

// Time to end in good order. A driver that was asked to close may take longer than one whose work
// nobody waits for: longer than the other side waits (connection.c), which then kills it.
enum { VANISHED_S = 2, ASKED_S = 15 };

static atomic_bool closing; // the end was asked for

static void *watch(void *descriptor)
{
    struct pollfd one = {.fd = *(const int *)descriptor, .events = 0};
    while (poll(&one, 1, -1) < 1 || !(one.revents & (POLLHUP | POLLERR | POLLNVAL)))
        continue;
    sleep(VANISHED_S); // by now the last request was read, if one is read at all
    if (atomic_load(&closing))
        sleep(ASKED_S - VANISHED_S);
    _exit(sb_status_rows[SB_INTERRUPTED].exit_code);
}

static bool start_watch(int *descriptor)
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, watch, descriptor) != 0)
        return false;
    pthread_detach(thread);
    return true;
}

int sb_worker_main(const struct sb_runner_fns *(*runner)(const struct sb_context_params *,
                                                         struct sb_error *err))
{
    static int in; // the watch outlives this function
    const int out = fcntl(1, F_DUPFD_CLOEXEC, 3);
    in = fcntl(0, F_DUPFD_CLOEXEC, 3);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (out < 0 || in < 0 || nothing < 0 || dup2(nothing, 0) < 0 || dup2(2, 1) < 0 ||
        signal(SIGINT, SIG_IGN) == SIG_ERR || signal(SIGPIPE, SIG_IGN) == SIG_ERR ||
        !start_watch(&in)) {
        sb_warn("this worker's descriptors cannot be set up");
        return sb_status_rows[SB_INTERNAL].exit_code;
    }
    return sb_serve(&(struct sb_serve_params){
        .in = in, .out = out, .runner = runner, .closing = &closing});
}
