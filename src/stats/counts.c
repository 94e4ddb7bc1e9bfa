#include "stats/counts.h"

#include <math.h>
#include <string.h>

struct side {
    double least, median, most;
};

static struct side read_side(const double *value, int n, double *scratch)
{
    memcpy(scratch, value, (size_t)n * sizeof *scratch);
    sb_sort_doubles(scratch, n);
    return (struct side){scratch[0], sb_median(scratch, n), scratch[n - 1]};
}

static enum sb_gate_verdict judge(const struct sb_counts_reading *reading,
                                  double tolerance, int n)
{
    if (n < 2 || reading->repeatability > SB_COUNTS_STEADY * tolerance)
        return SB_GATE_INCONCLUSIVE;
    if (reading->ratio.lo > 1 + tolerance)
        return SB_GATE_CANDIDATE;
    if (reading->ratio.hi > 1 + tolerance)
        return SB_GATE_INCONCLUSIVE;
    return reading->ratio.hi < 1 - tolerance ? SB_GATE_IMPROVED : SB_GATE_PASS;
}

struct sb_counts_reading sb_counts_read(double tolerance, const double *base,
                                        const double *head, int n, double *scratch)
{
    struct sb_counts_reading reading = {
        .verdict = SB_GATE_INCONCLUSIVE,
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
    const struct side b = read_side(base, n, scratch), h = read_side(head, n, scratch);
    reading.ratio.point = h.median / b.median;
    reading.ratio.lo = h.least / b.most;
    reading.ratio.hi = h.most / b.least;
    reading.repeatability =
        fmax((b.most - b.least) / b.median, (h.most - h.least) / h.median);
    reading.verdict = judge(&reading, tolerance, n);
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
