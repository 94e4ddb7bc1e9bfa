// What the variants of a suite cost relative to the anchor, measured side by side as a gate does.
#pragma once

#include "gate/anchor.h"
#include "gate/metric.h"
#include "measure/driver.h"
#include "results/history_row.h"

struct sb_history_measure_params {
    // Its `measure`: processes, and of each of them budget, seed, batch, batch_ms.
    const struct sb_suite *suite;
    const struct sb_anchor *anchor;
    struct sb_driver_params driver;
    enum sb_metric metric;
    int pairs; // of each variant in each process, 1 .. SB_GATE_PAIRS_MAX
    const char *data_dir, *shaders;
};

struct sb_history_measured {
    // A plan entry each; time and commit are the caller's to set. A variant that could not be
    // measured in each of the processes has a status and no ratio.
    struct sb_history_row *row;
    int row_count;
    enum sb_metric metric; // that was used; never SB_METRIC_AUTO
    struct sb_caps caps;
    double seconds;
    int exit_code;         // the worst of the rows
    struct sb_arena arena; // texts of rows
};

// False when nothing could be measured: no driver, no timer, or the anchor does not draw; and when
// a signal came, after which there are no rows.
// *measured must be zeroed; free also after failure.
bool sb_history_measure(const struct sb_history_measure_params *params,
                        struct sb_history_measured *measured, struct sb_error *err);
void sb_history_measured_free(struct sb_history_measured *measured);
