// The gate's judgement on counts that repeat, as instructions do: is head's larger than base's by
// more than a tolerance? There is no noise to test against, so there are no p-values: a few repeats
// tell how well a side repeats, and where that is far better than the tolerance, the counts speak
// for themselves.
#pragma once

#include "stats/gate.h"

// Repeats of one side may differ by a quarter of the tolerance; else nothing is claimed.
#define SB_COUNTS_STEADY 0.25
enum { SB_COUNTS_REPEATS = 3 };

struct sb_counts_reading {
    enum sb_gate_verdict verdict;
    // Head over base: of the medians; lo and hi: the least and the largest that any repeat of the
    // one gives with any of the other. No confidence interval: the range of what was seen.
    struct sb_interval ratio;
    double repeatability; // of the side that repeats worse: (largest - least) / median
};

// - INVALID where a count is not positive and finite;
// - INCONCLUSIVE where there are fewer than two repeats, repeatability > SB_COUNTS_STEADY *
//   tolerance, or the tolerance lies within the ratio's range;
// - CANDIDATE where the whole range is above 1 + tolerance: a fresh process must see it too;
// - IMPROVED where it is below 1 - tolerance; else PASS.
// `scratch` has room for n values.
struct sb_counts_reading sb_counts_read(double tolerance, const double *base,
                                        const double *head, int n, double *scratch);

// What a fresh process's reading makes of a candidate: REGRESSION where it is one there, too.
enum sb_gate_verdict sb_counts_confirm(const struct sb_counts_reading *fresh);
