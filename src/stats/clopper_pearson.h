// How probable is what happened k times in n trials? Exact intervals: for alarms, coverage and
// other shares of few trials.
#pragma once

#include "stats/order.h"

// The one-sided bounds of Clopper and Pearson, "The use of confidence or fiducial limits
// illustrated in the case of the binomial", Biometrika 26, 1934, for 0 <= k <= n and n >= 1:
// each lies on its side of the true probability in at least `level` of all experiments, whatever
// that probability. `level` in (0, 1).
//
// The upper bound is the p with P(Binomial(n, p) <= k) = 1 - level, or 1 for k = n; the lower
// one has P(Binomial(n, p) >= k) = 1 - level, or is 0 for k = 0. NAN where k or n is out of range.
double sb_clopper_pearson_lower(int k, int n, double level);
double sb_clopper_pearson_upper(int k, int n, double level);

// Point k / n and both bounds, each at 1 - (1 - level) / 2.
struct sb_interval sb_clopper_pearson(int k, int n, double level);
