#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "stats/order.h"
#include "stats/series.h"

double sb_sign_autocorrelation(const double *values, int n, double centre)
{
    double products = 0, squares = 0, before = 0;
    for (int i = 0; i < n; i++) {
        const double sign = (values[i] > centre) - (values[i] < centre);
        products += before * sign;
        squares += sign * sign;
        before = sign;
    }
    return squares > 0 ? products / squares : NAN;
}

// How many of the sorted values are less than x; with `equal`, at most x.
static int count_up_to(const double *sorted, int n, double x, bool equal)
{
    int lo = 0, hi = n;
    while (lo < hi) {
        const int middle = lo + (hi - lo) / 2;
        if (sorted[middle] < x || (equal && !(sorted[middle] > x)))
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

double sb_rank_autocorrelation(const double *values, int n, double *scratch)
{
    double *sorted = scratch, *rank = scratch + n, products = 0, squares = 0;
    memcpy(sorted, values, (size_t)n * sizeof *values);
    sb_sort_doubles(sorted, n);
    // Twice the distance of a midrank from the mean of all.
    for (int i = 0; i < n; i++)
        rank[i] = count_up_to(sorted, n, values[i], false) +
                  count_up_to(sorted, n, values[i], true) - n;
    for (int i = 0; i < n; i++) {
        squares += rank[i] * rank[i];
        products += i > 0 ? rank[i - 1] * rank[i] : 0;
    }
    return squares > 0 ? products / squares : NAN;
}

static double median_of(const double *values, int n, double *scratch)
{
    memcpy(scratch, values, (size_t)n * sizeof *values);
    sb_sort_doubles(scratch, n);
    return sb_median(scratch, n);
}

double sb_drift(const double *values, int n, double *scratch)
{
    if (n < 4)
        return NAN;
    double least = INFINITY, most = -INFINITY;
    for (int quarter = 0; quarter < 4; quarter++) {
        const int begin = (int)((long long)n * quarter / 4);
        const int end = (int)((long long)n * (quarter + 1) / 4);
        const double median = median_of(values + begin, end - begin, scratch);
        least = fmin(least, median);
        most = fmax(most, median);
    }
    return (most - least) / median_of(values, n, scratch);
}
