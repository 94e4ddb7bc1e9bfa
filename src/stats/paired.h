// Two variants measured side by side: what one costs relative to the other. Pairing by
// round cancels what both suffer alike (clocks, heat, a busy machine).
#pragma once

#include "stats/order.h"

// The ratio b / a of n pairs of times > 0, where a[i] and b[i] were measured in the same
// round: the Hodges-Lehmann estimate over d = ln(b/a), that is the median of all Walsh
// averages (d[i] + d[j]) / 2 with i <= j, with the interval between the C-th Walsh
// average from either end,
//
//     C = floor(n(n+1)/4 - z sqrt(n(n+1)(2n+1)/24)),
//
// the normal approximation to the signed-rank distribution (Hollander, Wolfe and Chicken,
// Nonparametric Statistical Methods, 3rd ed., 3.2 and 3.3, where C is an integer),
// rounded to the safe side. d is taken as symmetric about its centre. All are given as
// ratios.
//
// Exact for every n, in O(n) memory: the Walsh averages are selected from, never listed.
// `scratch` has room for n values. NAN bounds where n is too small for the level; all NAN
// where a time is not positive.
struct sb_interval sb_paired_ratio(const double *a, const double *b, int n, double level,
                                   double *scratch);
