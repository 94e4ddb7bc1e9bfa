#include <math.h>
#include <string.h>

#include "stats/paired.h"
#include "stats/within.h"

enum { BLOCK = 5 };

struct sb_interval sb_within_run(const double *values, int n, double level,
                                 double *autocorrelation, double *scratch)
{
    if (n > 0)
        memcpy(scratch, values, (size_t)n * sizeof *values);
    sb_sort_doubles(scratch, n);
    struct sb_interval interval = sb_median_interval(scratch, n, level);
    const double rho = sb_sign_autocorrelation(values, n, interval.point);
    if (autocorrelation)
        *autocorrelation = rho;
    if (!(rho > SB_CORRELATED))
        return interval;

    const int blocks =
        n / BLOCK; // the few samples that fill no block still count in the point
    for (int i = 0; i < blocks; i++) {
        double block[BLOCK];
        memcpy(block, values + (size_t)i * BLOCK, sizeof block);
        sb_sort_doubles(block, BLOCK);
        scratch[i] = sb_median(block, BLOCK);
    }
    sb_sort_doubles(scratch, blocks);
    const struct sb_interval of_blocks = sb_median_interval(scratch, blocks, level);
    // Medians of blocks scatter about a point of their own: the interval goes around both.
    interval.lo = fmin(of_blocks.lo, interval.point);
    interval.hi = fmax(of_blocks.hi, interval.point);
    if (isnan(of_blocks.lo))
        interval.lo = interval.hi = NAN;
    return interval;
}
