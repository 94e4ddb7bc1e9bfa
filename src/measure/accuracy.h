// How wrong the picture of a task is, and why: read from the program that is timed, in its own
// target, against the reference in double.
#pragma once

#include "image/metrics.h"
#include "measure/split.h"
#include "measure/truths.h"

// Fills task->accuracy. What cannot be had (a program without probes, no float targets) leaves
// its part unknown and is noted; SB_INSTRUMENTATION becomes the status where the
// instrumented program draws another picture. Pictures of very many pixels and lights are drawn
// smaller, which is noted.
void sb_accuracy_measure(struct sb_task *task, const struct sb_driver *driver,
                         struct sb_truths *truths);

// Fills the columns of the error; those that are not known stay absent.
void sb_accuracy_fill(const struct sb_task *task, struct sb_row *row);

// The error heat map of a task's picture in its own target, which the caller frees.
bool sb_accuracy_heat(const struct sb_task *task, const struct sb_driver *driver,
                      struct sb_truths *truths, struct sb_image *heat,
                      struct sb_error *err);
