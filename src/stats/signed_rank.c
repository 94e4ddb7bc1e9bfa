#include <math.h>
#include <stdlib.h>

#include "stats/signed_rank.h"

enum { EXACT_MAX = 25 };
enum { EXACT_SUMS = EXACT_MAX * (EXACT_MAX + 1) + 1 }; // sums of doubled ranks, from 0

static int by_size(const void *a, const void *b)
{
    const double x = fabs(*(const double *)a), y = fabs(*(const double *)b);
    return (x > y) - (x < y);
}

// The ranks are doubled throughout, so that those shared by ties are integers too.
struct sums {
    double above;   // of the ranks above the shift
    double all;     // … and of all but the zeros'
    double squares; // of the latter
};

// End of the group of equal size that starts at `begin`; its doubled rank is begin + end + 1.
static int end_of_ties(const double *x, int n, int begin)
{
    int end = begin + 1;
    while (end < n && !(fabs(x[end]) > fabs(x[begin])))
        end++;
    return end;
}

static struct sums sum_ranks(const double *x, int n)
{
    struct sums sums = {0, 0, 0};
    for (int begin = 0, end; begin < n; begin = end) {
        end = end_of_ties(x, n, begin);
        const double rank = begin + end + 1;
        for (int i = begin; i < end; i++) {
            sums.above += x[i] > 0 ? rank : 0;
            sums.all += x[i] > 0 || x[i] < 0 ? rank : 0;
            sums.squares += x[i] > 0 || x[i] < 0 ? rank * rank : 0;
        }
    }
    return sums;
}

// P(sum >= at_least): each rank is in the sum or not, with probability 1/2.
static double exact_tail(const double *x, int n, int at_least)
{
    double p[EXACT_SUMS] = {1}, tail = 0;
    int most = 0;
    for (int begin = 0, end; begin < n; begin = end) {
        end = end_of_ties(x, n, begin);
        const int rank = begin + end + 1;
        for (int i = begin; i < end; i++) {
            if (!(x[i] > 0 || x[i] < 0))
                continue;
            most += rank;
            for (int sum = most; sum >= 0; sum--)
                p[sum] = (p[sum] + (sum >= rank ? p[sum - rank] : 0)) / 2;
        }
    }
    for (int sum = most; sum >= at_least; sum--)
        tail += p[sum];
    return tail;
}

static double normal_tail(const struct sums *sums, double at_least)
{
    const double deviation = sqrt(sums->squares) / 2;
    const double excess = at_least - sums->all / 2 - 1; // 1/2, doubled
    return deviation > 0 ? erfc(excess / deviation / sqrt(2)) / 2 : 1;
}

double sb_signed_rank_p(const double *d, int n, double shift,
                        enum sb_alternative alternative, double *scratch)
{
    if (n < 1 || n > SB_SIGNED_RANK_MAX)
        return NAN;
    for (int i = 0; i < n; i++) {
        scratch[i] = d[i] - shift;
        if (isnan(scratch[i]))
            return NAN;
    }
    qsort(scratch, (size_t)n, sizeof *scratch, by_size);
    const struct sums sums = sum_ranks(scratch, n);
    // Below the shift is above it with all signs turned.
    const double seen = alternative == SB_GREATER ? sums.above : sums.all - sums.above;
    return n <= EXACT_MAX ? exact_tail(scratch, n, (int)seen) : normal_tail(&sums, seen);
}
