#include <limits.h>
#include <math.h>
#include <string.h>

#include "stats/critical.h"
#include "stats/order.h"
#include "stats/power.h"

static const double price_of_ranks = 1.02;

double sb_robust_spread(const double *values, int n, double *scratch)
{
    if (n < 1)
        return NAN;
    memcpy(scratch, values, (size_t)n * sizeof *values);
    sb_sort_doubles(scratch, n);
    const double centre = sb_median(scratch, n);
    for (int i = 0; i < n; i++)
        scratch[i] = fabs(values[i] - centre);
    sb_sort_doubles(scratch, n);
    return 1.4826 * sb_median(scratch, n);
}

// In units of the spread over sqrt(n).
static double reach(double alpha, double power)
{
    return price_of_ranks *
           (sb_normal_critical(1 - 2 * alpha) + sb_normal_critical(2 * power - 1));
}

// Rounding must not add one.
static int to_count(double pairs)
{
    const double up = ceil(pairs * (1 - 1e-12));
    return !(up < INT_MAX) ? INT_MAX : up > 1 ? (int)up : 1;
}

double sb_detectable_effect(double spread, int n, double alpha, double power)
{
    return reach(alpha, power) * spread / sqrt(n);
}

double sb_detection_power(double spread, int n, double alpha, double effect)
{
    const double z =
        effect * sqrt(n) / (price_of_ranks * spread) - sb_normal_critical(1 - 2 * alpha);
    return spread > 0 ? 0.5 * erfc(-z / sqrt(2)) : effect > 0;
}

int sb_pairs_to_detect(double spread, double effect, double alpha, double power)
{
    if (!(effect > 0))
        return INT_MAX;
    return to_count(pow(reach(alpha, power) * spread / effect, 2));
}

int sb_pairs_for_interval(double spread, double half_width, double level)
{
    if (!(half_width > 0))
        return INT_MAX;
    return to_count(
        pow(sb_normal_critical(level) * price_of_ranks * spread / half_width, 2));
}
