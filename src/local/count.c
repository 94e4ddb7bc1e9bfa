#define _DEFAULT_SOURCE // syscall
#include "local/count.h"

#include <unistd.h>

#include "job/callgrind.h"

#ifdef SB_HAVE_VALGRIND
#include <valgrind/callgrind.h>
#endif
#ifdef SB_HAVE_PERF_EVENT
#include <linux/perf_event.h>
#include <sys/syscall.h>
#endif

// --- callgrind -------------------------------------------------------------------------------

#ifdef SB_HAVE_VALGRIND

// Under another tool of valgrind the first request leaves no file, and that is an error.
static bool callgrind_open(struct sb_counter *counter)
{
    return RUNNING_ON_VALGRIND && counter->folder;
}

static void callgrind_start(struct sb_counter *counter)
{
    (void)counter;
    CALLGRIND_START_INSTRUMENTATION;
}

static void callgrind_stop(struct sb_counter *counter)
{
    (void)counter;
    CALLGRIND_STOP_INSTRUMENTATION;
}

// Writing the file sets the counts back to 0.
static bool callgrind_read(struct sb_counter *counter, int64_t *instructions,
                           struct sb_error *err)
{
    CALLGRIND_DUMP_STATS;
    return sb_callgrind_take(counter->folder, (int)getpid(), instructions, err);
}

static void callgrind_close(struct sb_counter *counter)
{
    (void)counter;
}

static const struct sb_counter_fns callgrind = {
    .name = "callgrind",
    .help = "valgrind simulates a processor and counts what it executes",
    .open = callgrind_open,
    .start = callgrind_start,
    .stop = callgrind_stop,
    .read = callgrind_read,
    .close = callgrind_close,
};

// What counts under valgrind counts valgrind, too.
static bool simulated(void)
{
    return RUNNING_ON_VALGRIND;
}
#else
static bool simulated(void)
{
    return false;
}
#endif

// --- perf_event ------------------------------------------------------------------------------

#ifdef SB_HAVE_PERF_EVENT

static bool perf_event_open(struct sb_counter *counter)
{
    struct perf_event_attr attributes = {
        .type = PERF_TYPE_HARDWARE,
        .size = sizeof attributes,
        .config = PERF_COUNT_HW_INSTRUCTIONS,
        .read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING,
        .inherit = 1,
        .exclude_kernel = 1,
        .exclude_hv = 1,
    };
    if (simulated())
        return false;
    counter->fd =
        (int)syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
    return counter->fd >= 0;
}

// With `inherit` a read sums over the threads; a reset would leave theirs, so differences are
// taken. -1: it failed, or others have had the processor's counter for a part of the time.
static int64_t perf_event_now(const struct sb_counter *counter)
{
    struct {
        uint64_t value, enabled_ns, running_ns;
    } got;
    return read(counter->fd, &got, sizeof got) == (ssize_t)sizeof got &&
                   got.running_ns == got.enabled_ns
               ? (int64_t)got.value
               : -1;
}

static void perf_event_start(struct sb_counter *counter)
{
    counter->begin = perf_event_now(counter);
}

static void perf_event_stop(struct sb_counter *counter)
{
    counter->end = perf_event_now(counter);
}

static bool perf_event_read(struct sb_counter *counter, int64_t *instructions,
                            struct sb_error *err)
{
    *instructions = counter->end - counter->begin;
    return (counter->begin >= 0 && counter->end >= 0) ||
           sb_fail(err, SB_INTERNAL,
                   "the kernel's counter of instructions could not be read, or others "
                   "have used it meanwhile");
}

static void perf_event_close(struct sb_counter *counter)
{
    close(counter->fd);
}

static const struct sb_counter_fns perf_event = {
    .name = "perf_event",
    .help = "the processor counts what it executes, and the kernel tells",
    .open = perf_event_open,
    .start = perf_event_start,
    .stop = perf_event_stop,
    .read = perf_event_read,
    .close = perf_event_close,
};
#endif

// --- the table -------------------------------------------------------------------------------

const struct sb_counter_fns *const sb_counters[] = {
#ifdef SB_HAVE_PERF_EVENT
    &perf_event,
#endif
#ifdef SB_HAVE_VALGRIND
    &callgrind,
#endif
    NULL,
};

bool sb_counter_open(struct sb_counter *counter, const char *folder)
{
    for (int i = 0; sb_counters[i]; i++) {
        *counter = (struct sb_counter){.folder = folder, .fd = -1};
        if (sb_counters[i]->open(counter)) {
            counter->fns = sb_counters[i];
            return true;
        }
    }
    *counter = (struct sb_counter){0};
    return false;
}

void sb_counter_close(struct sb_counter *counter)
{
    if (counter->fns)
        counter->fns->close(counter);
    *counter = (struct sb_counter){0};
}
