#include "stats/counts.h"

#include <math.h>
#include <string.h>

struct side { // the closest counts of one
    double least, median, most;
    double spread; // (most - least) / median
    int apart;
    double farthest;
};

static void find_apart(struct side *side, const double *sorted, int n, double steady)
{
    for (int i = 0; i < n; i++) {
        const double off = sorted[i] / side->median - 1;
        if (sorted[i] >= side->least && sorted[i] <= side->most)
            continue;
        if (fabs(off) > steady)
            side->apart++;
        if (fabs(off) > steady && fabs(off) > fabs(side->farthest))
            side->farthest = off;
    }
}

static struct side read_side(const double *value, int n, double steady, double *scratch)
{
    const int wanted = n < SB_COUNTS_REPEATS ? n : SB_COUNTS_REPEATS;
    memcpy(scratch, value, (size_t)n * sizeof *scratch);
    sb_sort_doubles(scratch, n);
    int first = 0;
    for (int i = 1; i + wanted <= n; i++)
        if (scratch[i + wanted - 1] - scratch[i] <
            scratch[first + wanted - 1] - scratch[first])
            first = i;
    struct side side = {
        .least = scratch[first],
        .median = sb_median(scratch + first, wanted),
        .most = scratch[first + wanted - 1],
    };
    side.spread = (side.most - side.least) / side.median;
    find_apart(&side, scratch, n, steady);
    return side;
}

static enum sb_gate_verdict judge(const struct sb_counts_reading *reading,
                                  double tolerance, bool over)
{
    const bool steady = reading->n >= SB_COUNTS_REPEATS &&
                        reading->repeatability <= SB_COUNTS_STEADY * tolerance;
    if (!steady)
        return over || reading->n >= SB_COUNTS_MOST ? SB_GATE_INCONCLUSIVE : SB_GATE_OPEN;
    if (reading->ratio.lo > 1 + tolerance)
        return SB_GATE_CANDIDATE;
    if (reading->ratio.hi > 1 + tolerance)
        return SB_GATE_INCONCLUSIVE;
    return reading->ratio.hi < 1 - tolerance ? SB_GATE_IMPROVED : SB_GATE_PASS;
}

struct sb_counts_reading sb_counts_read(double tolerance, const double *base,
                                        const double *head, int n, bool over,
                                        double *scratch)
{
    struct sb_counts_reading reading = {
        .verdict = over ? SB_GATE_INCONCLUSIVE : SB_GATE_OPEN,
        .n = n,
        .base = NAN,
        .head = NAN,
        .ratio = {NAN, NAN, NAN, n},
        .repeatability = NAN,
    };
    for (int i = 0; i < n; i++)
        if (!(base[i] > 0 && head[i] > 0 && isfinite(base[i]) && isfinite(head[i]))) {
            reading.verdict = SB_GATE_INVALID;
            return reading;
        }
    if (n < 1)
        return reading;
    const double steady = SB_COUNTS_STEADY * tolerance;
    const struct side b = read_side(base, n, steady, scratch),
                      h = read_side(head, n, steady, scratch);
    reading.base = b.median;
    reading.head = h.median;
    reading.ratio.point = h.median / b.median;
    reading.ratio.lo = h.least / b.most;
    reading.ratio.hi = h.most / b.least;
    reading.repeatability = fmax(b.spread, h.spread);
    reading.apart = b.apart + h.apart;
    reading.farthest = fabs(b.farthest) > fabs(h.farthest) ? b.farthest : h.farthest;
    reading.verdict = judge(&reading, tolerance, over);
    return reading;
}

enum sb_gate_verdict sb_counts_confirm(const struct sb_counts_reading *fresh)
{
    if (fresh->verdict == SB_GATE_CANDIDATE)
        return SB_GATE_REGRESSION;
    return fresh->verdict == SB_GATE_PASS || fresh->verdict == SB_GATE_IMPROVED
               ? SB_GATE_NOT_CONFIRMED
               : SB_GATE_INCONCLUSIVE;
}
