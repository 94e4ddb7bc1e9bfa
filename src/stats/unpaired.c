#include <math.h>
#include <stdbool.h>

#include "stats/critical.h"
#include "stats/unpaired.h"

static struct sb_interval make(const struct sb_interval *a, const struct sb_interval *b,
                               double below, double above)
{
    const double centre = log(b->point) - log(a->point);
    return (struct sb_interval){exp(centre), exp(centre - below), exp(centre + above),
                                a->n + b->n};
}

static bool has_points(const struct sb_interval *a, const struct sb_interval *b)
{
    return a->point > 0 && b->point > 0;
}

struct sb_interval sb_unpaired_within(const struct sb_interval *a,
                                      const struct sb_interval *b)
{
    if (!has_points(a, b))
        return (struct sb_interval){NAN, NAN, NAN, 2};
    const double below = hypot(log(b->point / b->lo), log(a->hi / a->point));
    const double above = hypot(log(b->hi / b->point), log(a->point / a->lo));
    struct sb_interval ratio = make(a, b, below, above);
    ratio.n = 2;
    return ratio;
}

// The sum of squared deviations of the logarithms, from the interval that was made of it.
static double squares_of(const struct sb_interval *side, double level)
{
    if (side->n < 2)
        return 0;
    const double reach = log(side->hi / side->lo) / 2;
    const double error = reach / sb_student_critical(level, side->n - 1);
    return error * error * side->n * (side->n - 1);
}

struct sb_interval sb_unpaired_between(const struct sb_interval *a,
                                       const struct sb_interval *b, double level)
{
    const int df = a->n + b->n - 2;
    if (!has_points(a, b))
        return (struct sb_interval){NAN, NAN, NAN, a->n + b->n};
    if (df < 1)
        return make(a, b, NAN, NAN);
    const double variance = (squares_of(a, level) + squares_of(b, level)) / df;
    const double reach =
        sb_student_critical(level, df) * sqrt(variance / a->n + variance / b->n);
    return make(a, b, reach, reach);
}
