#include <math.h>
#include <stdint.h>
#include <string.h>

#include "stats/critical.h"
#include "stats/paired.h"

// How many sums sorted[i] + sorted[j], i <= j, are at most x. The rounded sum still grows
// with each summand, so one sweep from both ends sees them all.
static int64_t sums_up_to(const double *sorted, int n, double x)
{
    int64_t count = 0;
    int j = n - 1;
    for (int i = 0; i < n && i <= j; i++) {
        while (j >= i && sorted[i] + sorted[j] > x)
            j--;
        count += j - i + 1;
    }
    return count;
}

// A double's place among all doubles: IEEE 754 numbers of one sign are ordered like their
// bits.
static int64_t to_place(double x)
{
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits < 0 ? INT64_MIN - bits : bits;
}

static double from_place(int64_t place)
{
    const int64_t bits = place < 0 ? INT64_MIN - place : place;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

// The rank-th smallest Walsh average, from 1: by bisection over the doubles themselves,
// so the answer is the very sum that would stand there in a sorted list of all of them.
static double walsh_average(const double *sorted, int n, int64_t rank)
{
    int64_t lo = to_place(2 * sorted[0]), hi = to_place(2 * sorted[n - 1]);
    while (lo < hi) {
        const int64_t middle = lo + (int64_t)(((uint64_t)hi - (uint64_t)lo) / 2);
        if (sums_up_to(sorted, n, from_place(middle)) < rank)
            lo = middle + 1;
        else
            hi = middle;
    }
    return from_place(lo) / 2;
}

struct sb_interval sb_paired_ratio(const double *a, const double *b, int n, double level,
                                   double *scratch)
{
    struct sb_interval interval = {NAN, NAN, NAN, n};
    for (int i = 0; i < n; i++) {
        if (!(a[i] > 0 && b[i] > 0))
            return interval;
        scratch[i] = log(b[i] / a[i]);
    }
    if (n < 1)
        return interval;
    sb_sort_doubles(scratch, n);

    const int64_t count = (int64_t)n * (n + 1) / 2;
    const double low = walsh_average(scratch, n, (count + 1) / 2);
    const double high = walsh_average(scratch, n, count / 2 + 1);
    interval.point = exp((low + high) / 2);

    const double pairs = (double)n * (n + 1), spread = sqrt(pairs * (2.0 * n + 1) / 24);
    const double rank = floor(pairs / 4 - sb_normal_critical(level) * spread);
    if (rank >= 1) {
        interval.lo = exp(walsh_average(scratch, n, (int64_t)rank));
        interval.hi = exp(walsh_average(scratch, n, count + 1 - (int64_t)rank));
    }
    return interval;
}
