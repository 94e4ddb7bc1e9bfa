// What repeated processes say. The level of a driver moves from process to process
// (memory layout, thread placement, clocks) by more than any interval within one process
// admits, so each process counts as one observation.
#pragma once

#include "stats/order.h"

// Geometric mean of the medians of n processes, all > 0, with Student's t interval over
// their logarithms: times vary by factors, not by summands. NAN bounds for n < 2; all NAN
// where a median is not positive.
struct sb_interval sb_between_processes(const double *process_medians, int n,
                                        double level);
