// Two levels that were measured apart, in processes of their own: the ratio b / a. No sample of one
// has a partner in the other, so nothing cancels, and what the interval covers is all that the
// intervals of the two levels cover.
//
// Both return all NAN where a point is not positive. .n is the number of processes.
#pragma once

#include "stats/order.h"

// From the intervals of two medians, one process each, both at one level, which the interval of the
// ratio then has, too. On logarithms, by the method of variance estimates recovery (Zou and
// Donner, "Construction of confidence limits about effect measures: a general approach",
// Statistics in Medicine 27(10), 2008): the distances from point to bound are added as squares,
//
//     ln lo = ln b/a - sqrt((ln b - ln b_lo)^2 + (ln a_hi - ln a)^2)
//
// and the other way round for hi. No distribution is assumed beyond what those intervals assume, and
// neither need be symmetric. It covers the ratio of the levels of these two processes, not of
// the two programs: what a process adds of its own is in neither. NAN bounds where one has none.
struct sb_interval sb_unpaired_within(const struct sb_interval *a,
                                      const struct sb_interval *b);

// From two results of sb_between_processes at `level`, with a->n and b->n processes: Student's t for
// two means with a common variance (Snedecor and Cochran, Statistical Methods, 8th ed., chapter
// 6) over the logarithms of the medians, a->n + b->n - 2 degrees of freedom. Each side's
// variance is read back from its interval. One side may have a single process, which then is
// taken to vary as the other's do; with less, the bounds are NAN.
struct sb_interval sb_unpaired_between(const struct sb_interval *a,
                                       const struct sb_interval *b, double level);
