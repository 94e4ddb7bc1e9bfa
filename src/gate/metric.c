#include "gate/metric.h"

#include <string.h>

#include "base/words.h"

const struct sb_metric_row sb_metric_rows[SB_METRIC_COUNT] = {
    [SB_METRIC_AUTO] = {"auto", "cpu where the context says that a CPU draws, else gpu",
                        NULL, "ns", 0.02},
    [SB_METRIC_CPU] = {"cpu", "CPU time of the process that draws, all threads",
                       "process CPU clock", "ns", 0.02},
    [SB_METRIC_GPU] = {"gpu", "the GL timer that passes its audit", NULL, "ns", 0.02},
    [SB_METRIC_WALL] = {"wall", "the monotonic clock around a drained batch",
                        "monotonic clock", "ns", 0.02},
    [SB_METRIC_INSTRUCTIONS] =
        {"instructions",
         "of one frame, counted by the kernel or by valgrind's callgrind, hardly varies: "
         "a second opinion on a CPU driver, which says nothing of a GPU",
         NULL, "instructions", 0.005},
};

bool sb_metric_find(const char *name, enum sb_metric *metric, struct sb_error *err)
{
    const char *names[SB_METRIC_COUNT];
    *metric = SB_METRIC_AUTO;
    for (int i = 0; i < SB_METRIC_COUNT; i++) {
        names[i] = sb_metric_rows[i].name;
        if (name && strcmp(names[i], name) == 0)
            *metric = (enum sb_metric)i;
    }
    if (!name || strcmp(name, names[*metric]) == 0)
        return true;
    return sb_fail_unknown(err, "", "metric", name, names, SB_METRIC_COUNT);
}

int64_t sb_metric_value(enum sb_metric metric, const struct sb_sample *sample)
{
    if (sample->flags != 0)
        return 0;
    switch (metric) {
    case SB_METRIC_CPU:
        return sample->cpu_ns;
    case SB_METRIC_WALL:
        return sample->wall_ns;
    case SB_METRIC_INSTRUCTIONS:
        return sample->instructions == SB_NO_TIME ? 0 : sample->instructions;
    default: // a timer source that reads no query is the wall clock
        return sample->gpu_ns == SB_NO_TIME ? sample->wall_ns : sample->gpu_ns;
    }
}
