// The interval of a median from the samples of one process, which depend on each other: a
// scheduler or a clock that disturbs one sample is likely to disturb the next.
#pragma once

#include "stats/order.h"

// Samples whose signs are correlated by more than this go by blocks.
#define SB_CORRELATED 0.2

// sb_median_interval of n values in the order in which they were measured. Where their sign
// autocorrelation is above SB_CORRELATED, the interval is that of the medians of blocks of
// five neighbours (non-overlapping batch means: Law, Simulation Modeling and Analysis,
// 9.5.3), while the point stays the median of all. *autocorrelation is set (NULL: not wanted).
// `scratch` has room for n values.
struct sb_interval sb_within_run(const double *values, int n, double level,
                                 double *autocorrelation, double *scratch);
