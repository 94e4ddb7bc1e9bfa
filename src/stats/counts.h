// The gate's judgement on counts that repeat, as instructions do: is head's larger than base's by
// more than a tolerance? There is no noise to test against, so there are no p-values: what most
// repeats agree on is the count, and where they agree far better than the tolerance, the counts
// speak for themselves.
//
// Once in a hundred frames or so a driver does what is no part of a frame, as to make a new buffer
// where many frames' uploads have filled one. Such a count stands apart, and a majority does not
// have it.
#pragma once

#include "stats/gate.h"

// Repeats of one side agree where they differ by a quarter of the tolerance at most.
#define SB_COUNTS_STEADY 0.25
enum { SB_COUNTS_REPEATS = 3, SB_COUNTS_MOST = 5 };
_Static_assert(2 * SB_COUNTS_REPEATS > SB_COUNTS_MOST, "those that agree are a majority");

struct sb_counts_reading {
    enum sb_gate_verdict verdict;
    int n; // counts of each side
    // The rest is of those that agree: of each side the SB_COUNTS_REPEATS closest to each other.
    double base, head; // medians
    // Head over base: of the medians; lo and hi: the least and the largest that any of the one
    // gives with any of the other. No confidence interval: the range of what was seen.
    struct sb_interval ratio;
    double repeatability; // of the side that repeats worse: (largest - least) / median
    int apart;            // of both sides: counts that do not agree with these
    double farthest;      // the farthest count over these, less 1; 0: none is apart
};

// - INVALID where a count is not positive and finite;
// - OPEN where more counts of both sides are wanted: fewer than SB_COUNTS_REPEATS, or these do not
//   agree and there are fewer than SB_COUNTS_MOST. INCONCLUSIVE instead where it is over;
// - INCONCLUSIVE where the tolerance lies within the ratio's range;
// - CANDIDATE where the whole range is above 1 + tolerance: a fresh process must see it too;
// - IMPROVED where it is below 1 - tolerance; else PASS.
// `scratch` has room for n values.
struct sb_counts_reading sb_counts_read(double tolerance, const double *base,
                                        const double *head, int n, bool over,
                                        double *scratch);

// What a fresh process's reading makes of a candidate: REGRESSION where it is one there, too.
enum sb_gate_verdict sb_counts_confirm(const struct sb_counts_reading *fresh);
