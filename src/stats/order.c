#include <math.h>
#include <stdlib.h>

#include "stats/order.h"

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void sb_sort_doubles(double *values, int n)
{
    if (n > 1)
        qsort(values, (size_t)n, sizeof *values, ascending);
}

double sb_median(const double *sorted, int n)
{
    if (n <= 0)
        return NAN;
    // Halved first: the sum of two large values may overflow.
    return n % 2 ? sorted[n / 2] : sorted[n / 2 - 1] / 2 + sorted[n / 2] / 2;
}

double sb_quantile(const double *sorted, int n, double p)
{
    if (n <= 0)
        return NAN;
    const double place = (n - 1) * p;
    const int below = (int)place;
    if (below >= n - 1)
        return sorted[n - 1];
    return sorted[below] + (place - below) * (sorted[below + 1] - sorted[below]);
}

// The largest k with P(Binomial(n, 1/2) <= k - 1) <= tail, or 0 where there is none.
static int rank_for(int n, double tail)
{
    // C(n, k) and its running sum, both times 2^exponent: 2^-n alone would underflow from
    // n = 1075 on. All terms are positive and, up to 2^53, exact.
    double term = 1, sum = 1;
    int exponent = -n, k = 0;
    while (ldexp(sum, exponent) <= tail) {
        k++;
        term = term * (n - k + 1) / k;
        sum += term;
        if (sum > 0x1p500) {
            term = ldexp(term, -500);
            sum = ldexp(sum, -500);
            exponent += 500;
        }
    }
    return k;
}

struct sb_interval sb_median_interval(const double *sorted, int n, double level)
{
    struct sb_interval interval = {sb_median(sorted, n), NAN, NAN, n};
    const int k = n > 0 ? rank_for(n, (1 - level) / 2) : 0;
    if (k > 0) {
        interval.lo = sorted[k - 1];
        interval.hi = sorted[n - k];
    }
    return interval;
}
