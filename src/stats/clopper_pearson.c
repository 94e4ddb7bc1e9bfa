// The bounds are quantiles of beta distributions; here they are found by bisection on the
// binomial tail that defines them.

#include <math.h>
#include <stdbool.h>

#include "stats/clopper_pearson.h"

// ln of n over k.
static double log_choose(int n, int k)
{
    const int few = k < n - k ? k : n - k;
    double sum = 0;
    for (int i = 1; i <= few; i++)
        sum += log((double)(n - few + i) / i);
    return sum;
}

// ln P(Binomial(n, p) >= k), k >= 1, p being x or, if `far`, 1 - x: the first term and the sum of
// all over it. That overflows only where nearly everything is beyond k, and infinity is as good
// then.
static double log_tail(double choose, int n, int k, double x, bool far)
{
    const double odds = far ? (1 - x) / x : x / (1 - x);
    double term = 1, sum = 1;
    for (int j = k; j < n; j++) {
        const double factor = (double)(n - j) / (j + 1) * odds;
        term *= factor;
        sum += term;
        if ((factor < 0.5 && term < 1e-17 * sum) || isinf(sum))
            break;
    }
    const double in = far ? log1p(-x) : log(x), out = far ? log(x) : log1p(-x);
    return choose + k * in + (n - k) * out + log(sum);
}

// The x at which that is ln `tail`, to its last digits: whether p or 1 - p is the small one, the
// caller asks for the one it wants.
static double solve(int n, int k, double tail, bool far)
{
    const double choose = log_choose(n, k), target = log(tail);
    double lo = 0, hi = 1;
    for (;;) {
        const double middle = lo + (hi - lo) / 2;
        if (middle <= lo || middle >= hi)
            return middle;
        if ((log_tail(choose, n, k, middle, far) < target) != far)
            lo = middle;
        else
            hi = middle;
    }
}

double sb_clopper_pearson_lower(int k, int n, double level)
{
    if (k < 0 || k > n || n < 1)
        return NAN;
    return k == 0 ? 0 : solve(n, k, 1 - level, false);
}

// At most k of one kind are at least n - k of the other.
double sb_clopper_pearson_upper(int k, int n, double level)
{
    if (k < 0 || k > n || n < 1)
        return NAN;
    return k == n ? 1 : solve(n, n - k, 1 - level, true);
}

struct sb_interval sb_clopper_pearson(int k, int n, double level)
{
    const double each = 1 - (1 - level) / 2;
    return (struct sb_interval){(double)k / n, sb_clopper_pearson_lower(k, n, each),
                                sb_clopper_pearson_upper(k, n, each), n};
}
