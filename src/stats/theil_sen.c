#include <math.h>
#include <string.h>

#include "stats/critical.h"
#include "stats/theil_sen.h"

int sb_theil_sen_room(int n)
{
    return n * (n - 1) / 2 + n;
}

// --- how many pairs may be discordant -----------------------------------------------------

enum { EXACT_POINTS = 18 }; // 18! is the last whose orders a double counts exactly
enum { EXACT_PAIRS = EXACT_POINTS * (EXACT_POINTS - 1) / 2 };

// Times (1 - q^d), and divided by it; the quotient must be a polynomial.
static void multiply(double *term, int degree, int d)
{
    for (int k = degree; k >= d; k--)
        term[k] -= term[k - d];
}

static void divide(double *term, int degree, int d)
{
    for (int k = d; k <= degree; k++)
        term[k] += term[k - d];
}

// orders[k]: in how many orders of the y just k pairs of different x are discordant, with the
// orders inside a tie counted once: the coefficients of the q-multinomial
// [n]! / ([t1]! [t2]! ...), where [m]! is the product of (1 - q^i) / (1 - q), i <= m. Each partial
// product is an integer polynomial, so nothing is rounded.
static void count_orders(const int *tie, int ties, int n, double *orders)
{
    memset(orders, 0, (EXACT_PAIRS + 1) * sizeof *orders);
    orders[0] = 1;
    for (int i = 2; i <= n; i++) {
        multiply(orders, EXACT_PAIRS, i);
        divide(orders, EXACT_PAIRS, 1);
    }
    for (int t = 0; t < ties; t++)
        for (int i = 2; i <= tie[t]; i++) {
            multiply(orders, EXACT_PAIRS, 1);
            divide(orders, EXACT_PAIRS, i);
        }
}

// The largest M with P(D < M) <= tail, or 0.
static int exact_rank(const int *tie, int ties, int n, int pairs, double tail)
{
    double orders[EXACT_PAIRS + 1], all = 0, sum = 0;
    count_orders(tie, ties, n, orders);
    for (int k = 0; k <= pairs; k++)
        all += orders[k];
    int rank = 0;
    tail *= 1 + 1e-12; // 1 - 0.9 is a little less than a tenth
    while (rank < pairs && sum + orders[rank] <= tail * all)
        sum += orders[rank++];
    return rank;
}

// The variance of (concordant - discordant) pairs is that of Sen, (2.6), with ties in x.
static int normal_rank(const int *tie, int ties, int n, int pairs, double level)
{
    double variance = (double)n * (n - 1) * (2 * n + 5);
    for (int t = 0; t < ties; t++)
        variance -= (double)tie[t] * (tie[t] - 1) * (2 * tie[t] + 5);
    const double reach = sb_normal_critical(level) * sqrt(variance / 18);
    const double rank = floor((pairs - reach) / 2);
    return rank > 0 ? (int)rank : 0;
}

// Sizes of the groups of equal x; `scratch` has room for n values.
static int find_ties(const double *x, int n, double *scratch, int *tie)
{
    int ties = 0;
    memcpy(scratch, x, (size_t)n * sizeof *x);
    sb_sort_doubles(scratch, n);
    for (int i = 0; i < n; i++)
        if (i == 0 || scratch[i] > scratch[i - 1])
            tie[ties++] = 1;
        else
            tie[ties - 1]++;
    return ties;
}

// --- the line -----------------------------------------------------------------------------

double sb_line_level(const double *x, const double *y, int n, double slope,
                     double *scratch)
{
    for (int i = 0; i < n; i++)
        scratch[i] = y[i] - slope * x[i];
    sb_sort_doubles(scratch, n);
    return sb_median(scratch, n);
}

struct sb_line sb_theil_sen(const double *x, const double *y, int n, double level,
                            double *scratch)
{
    struct sb_line line = {{NAN, NAN, NAN, 0}, NAN};
    int tie[SB_LINE_POINTS_MAX], pairs = 0;
    if (n < 2 || n > SB_LINE_POINTS_MAX)
        return line;
    const int ties = find_ties(x, n, scratch, tie);
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            if (x[i] < x[j] || x[i] > x[j])
                scratch[pairs++] = (y[j] - y[i]) / (x[j] - x[i]);
    if (pairs == 0)
        return line;
    sb_sort_doubles(scratch, pairs);
    line.slope.n = pairs;
    line.slope.point = sb_median(scratch, pairs);
    const int rank = n <= EXACT_POINTS ? exact_rank(tie, ties, n, pairs, (1 - level) / 2)
                                       : normal_rank(tie, ties, n, pairs, level);
    if (rank > 0) {
        line.slope.lo = scratch[rank - 1];
        line.slope.hi = scratch[pairs - rank];
    }
    line.intercept = sb_line_level(x, y, n, line.slope.point, scratch);
    return line;
}

// --- two segments -------------------------------------------------------------------------

static double distance_behind(double x, double at)
{
    return x > at ? x - at : 0;
}

static double deviation_of(const double *z, const double *y, int n, double level,
                           double slope)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fabs(y[i] - level - slope * z[i]);
    return sum;
}

// The line of least absolute deviation: one of those through two points. Its deviation.
static double least_line(const double *z, const double *y, int n, double *level,
                         double *slope)
{
    double least = INFINITY;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++) {
            if (!(z[i] < z[j]))
                continue;
            const double b = (y[j] - y[i]) / (z[j] - z[i]), a = y[i] - b * z[i];
            const double sum = deviation_of(z, y, n, a, b);
            if (sum < least) {
                least = sum;
                *level = a;
                *slope = b;
            }
        }
    return least;
}

static void keep_better(struct sb_bend *best, const struct sb_bend *other)
{
    if (other->deviation < best->deviation)
        *best = *other;
}

// The best bend with its break at `at`.
static void try_break(const double *x, const double *y, int n, double at, double *z,
                      struct sb_bend *best)
{
    struct sb_bend bend = *best;
    bend.at = at;
    for (int i = 0; i < n; i++)
        z[i] = distance_behind(x[i], at);
    bend.deviation = least_line(z, y, n, &bend.level, &bend.slope);
    keep_better(best, &bend);
}

// The first `flat` points and the rest, each fitted alone, if they meet between the two.
static void try_apart(const double *x, const double *y, int n, int flat, double *scratch,
                      struct sb_bend *best)
{
    struct sb_bend bend = *best;
    double level = NAN;
    const double rest = least_line(x + flat, y + flat, n - flat, &level, &bend.slope);
    memcpy(scratch, y, (size_t)flat * sizeof *y);
    sb_sort_doubles(scratch, flat);
    bend.level = sb_median(scratch, flat);
    bend.at = (bend.level - level) / bend.slope;
    bend.deviation = rest;
    for (int i = 0; i < flat; i++)
        bend.deviation += fabs(y[i] - bend.level);
    if (bend.at >= x[flat - 1] && bend.at <= x[flat])
        keep_better(best, &bend);
}

bool sb_bend_fit(const double *x, const double *y, int n, double *scratch,
                 struct sb_bend *bend)
{
    double level = NAN, slope = NAN;
    *bend = (struct sb_bend){NAN, NAN, NAN, INFINITY, INFINITY};
    if (n < 4)
        return false;
    bend->line_deviation = least_line(x, y, n, &level, &slope);
    for (int flat = 2; flat < n - 1; flat++) {
        const bool between = x[flat - 1] < x[flat];
        if (!between || !(x[0] < x[flat - 1]) || !(x[flat] < x[n - 1]))
            continue;
        try_apart(x, y, n, flat, scratch, bend);
        try_break(x, y, n, x[flat - 1], scratch, bend);
        try_break(x, y, n, x[flat], scratch, bend);
    }
    return isfinite(bend->deviation);
}

// Less is better. A perfect fit has the least that there is.
static double criterion(double deviation, int n, int k)
{
    return 2.0 * n * log(deviation / n) + 2.0 * k +
           2.0 * k * (k + 1) / (double)(n - k - 1);
}

bool sb_bend_is_clear(const struct sb_bend *bend, const double *x, const double *y, int n,
                      double *scratch)
{
    double size = 0;
    int flat = 0;
    for (int i = 0; i < n; i++)
        size += fabs(y[i]);
    // What rounding leaves of a straight line has no bend.
    if (n < 6 || !(bend->slope > 0) || !(bend->line_deviation > 1e-9 * size) ||
        !(criterion(bend->deviation, n, 4) < criterion(bend->line_deviation, n, 3)))
        return false;
    while (flat < n && x[flat] <= bend->at)
        flat++;
    const double rise = sb_theil_sen(x, y, flat, 0.95, scratch).slope.point;
    return fabs(rise) <= bend->slope / 5;
}
