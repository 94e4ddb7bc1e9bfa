// Where the level of a short series changes: ratios over commits, of which no single one is
// large enough for a gate, or which nobody gated.
#pragma once

#include "stats/order.h"

enum { SB_CHANGE_VALUES_MAX = 4096 };

struct sb_change_rule {
    int min_length; // of a segment, at least 2
    double
        min_magnitude; // 0.02: neighbouring levels differ by at least 2 %; 0: by anything
};

// Segments of at least 5 values whose levels differ by at least 2 %.
struct sb_change_rule sb_change_rule_default(void);

struct sb_segment {
    int start, n;             // values start .. start + n - 1
    struct sb_interval level; // median, with 95 % (stats/order.h), were the segment given
    double step;              // median over that of the segment before; 1 for the first
    double since_first;       // … over that of the first: what creeping has come to
};

// Divides values > 0, in the order of their commits, into segments of one level each; returns
// how many there are, at least 1, or 0 where n is not 1 .. SB_CHANGE_VALUES_MAX or a value not
// positive and finite. `segment` has room for sb_segments_max(n, rule), `scratch` for
// sb_change_points_room(n) values. Scaling all values scales the levels and changes nothing else.
//
// Over y = ln(value) the sum of |y - median of its segment| plus `penalty` a segment is made
// least, over all divisions that there are: the L1 Potts functional by dynamic programming
// (Friedrich, Kempe, Liebscher and Winkler, "Complexity penalized M-estimation: fast
// computation", Journal of Computational and Graphical Statistics 17, 2008), in O(n^2) segments.
// Medians, so that wild values in a row, fewer than half of min_length, are never a level.
//
//     penalty = 2 m (ln n + 2), m = median |y[i+1] - y[i]| / sqrt(2)
//
// What a needless boundary saves is about Z^2 / (4 f), Z being normal and f the density at the
// median; of normal, uniform and Laplace noise 1 / (4 f) is 0.7 to 1 of the median deviation m,
// and the largest of n such Z^2 grows like 2 ln n. m is taken from neighbours, which steps do not
// move. So of series that are but noise at most 5 % are divided at min_length 5 and magnitude 0
// (tests/stats_change_points.c: normal, uniform, Laplace, Student's t and spikes). The noise must
// be independent: values that drift together have levels that change.
//
// Then neighbours whose levels differ by less than min_magnitude are joined, the least different
// first, and their common level is taken anew: so steps that are each too small add up until
// they are large enough, and the boundary of a creep lies somewhere on it.
int sb_segments_max(int n, const struct sb_change_rule *rule);
int sb_change_points_room(int n);
int sb_change_points(const double *values, int n, const struct sb_change_rule *rule,
                     double *scratch, struct sb_segment *segment);
