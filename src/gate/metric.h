// What a gate compares of two batches.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "job/job.h"

enum sb_metric {
    SB_METRIC_AUTO, // cpu where the context says that a CPU draws, else gpu
    SB_METRIC_CPU,
    SB_METRIC_GPU,
    SB_METRIC_WALL,
    SB_METRIC_INSTRUCTIONS, // counted, not timed: stats/counts.h judges it
    SB_METRIC_COUNT
};

struct sb_metric_row {
    const char *name, *help;
    const char *source; // the clock; NULL: the timer that passed its audit
    const char *unit;
    double tolerance; // what head may cost more, where nobody says
};
extern const struct sb_metric_row sb_metric_rows[SB_METRIC_COUNT];

// SB_USAGE lists the valid ones. NULL: SB_METRIC_AUTO.
bool sb_metric_find(const char *name, enum sb_metric *metric, struct sb_error *err);

// The batch by this metric; 0 where it has none (flagged, lost, or not counted).
int64_t sb_metric_value(enum sb_metric metric, const struct sb_sample *sample);
