// Before the rounds: how many frames make a batch, is the driver warm, and is the time that
// of the fragments?
#pragma once

#include "measure/task.h"

// How long a batch is to be, in ns, as below.
double sb_calibrate_wanted_ns(const struct sb_driver *driver,
                              const struct sb_measure_settings *settings);

// Frames a batch: the fewest that last max(1000 x granularity, 50 x an empty query,
// 50 x what the audit saw the timer misread a batch by, batch_ms),
// but no more than a batch of 20 ms. Only ever grows the batch, so it can be asked again once
// the driver is warm and frames take less.
bool sb_calibrate_batch(struct sb_task *task, const struct sb_driver *driver,
                        const struct sb_measure_settings *settings, struct sb_error *err);

// Unrecorded rounds over all sound tasks until five totals agree within 5 %, for a twentieth of
// the budget at most (1 s at most); notes `no_steady_state` otherwise.
void sb_warm_up(struct sb_task *tasks, int count, const struct sb_driver *driver,
                const struct sb_measure_settings *settings);

// A quarter of the pixels must take a third of the time or less; else NOT_FRAGMENT_BOUND.
bool sb_check_fragment_bound(struct sb_task *task, const struct sb_driver *driver,
                             struct sb_error *err);

// Where a frame draws its shadow maps again: the share of its time that they take, the median
// of 15 pairs of a batch of whole frames and one of nothing but shadow maps, of about equal
// length.
bool sb_split_shadows(struct sb_task *task, const struct sb_driver *driver,
                      struct sb_error *err);
