// Lines through few points of which some may be far off: the slope is the median of all
// slopes between two points, so up to 29 % of the points may be anything.
#pragma once

#include <stdbool.h>

#include "stats/order.h"

enum { SB_LINE_POINTS_MAX = 256 };

struct sb_line {
    struct sb_interval slope; // of y over x; n: slopes between two points of different x
    double intercept;         // y at x = 0
};

// Theil's estimate with Sen's interval: point is the median of the slopes between all pairs of
// points of different x; the interval lies between the M-th slope from either end, with the
// largest M for which 2 P(D < M) <= 1 - level, D being the number of pairs in which y falls
// where x rises, if y does not depend on x (Sen, "Estimates of the regression coefficient based
// on Kendall's tau", JASA 63, 1968; Hollander, Wolfe and Chicken, Nonparametric Statistical
// Methods, 3rd ed., 9.2 and 9.3). Several points of one x are ties, for which P is right too.
// P is exact up to 18 points; beyond, the normal approximation with Sen's variance.
//
// The interval tells of scatter about the line, and needs at least five points of different x at
// 95 %; NAN bounds with fewer. Intercept: the median of y - slope x (ibid., 9.4). All NAN
// where no two x differ, or n is above SB_LINE_POINTS_MAX.
// `scratch` has room for sb_theil_sen_room(n) values.
int sb_theil_sen_room(int n);
struct sb_line sb_theil_sen(const double *x, const double *y, int n, double level,
                            double *scratch);

// The median of y - slope x, the level at which a line of that slope lies.
double sb_line_level(const double *x, const double *y, int n, double slope,
                     double *scratch); // room for n values

// Two segments that meet: y = level + slope max(x - at, 0), flat up to `at`.
struct sb_bend {
    double level, slope, at;
    double deviation;      // sum of |y - fit|
    double line_deviation; // the least that one straight line leaves
};

// The bend of least absolute deviation, with at least two different x on the flat part and two on
// the slope; `x` ascending. Where the two parts, each fitted alone, meet between its neighbours,
// that is the best for this place; else the best has its break on one of them, since what is
// minimised is convex (the argument of Hudson, "Fitting segmented curves whose join points have
// to be estimated", JASA 61, 1966, which holds for absolute deviations too). So the break may
// lie at a point or between two. False where there are fewer than four different x.
// `scratch` has room for 2 n values.
bool sb_bend_fit(const double *x, const double *y, int n, double *scratch,
                 struct sb_bend *bend);

// Is the bend a clear improvement over one line? Where Akaike's criterion with the correction
// for few points is lower for it,
//
//     AICc = 2 n ln(deviation / n) + 2 k + 2 k (k + 1) / (n - k - 1),
//
// k = 4 with the bend, 3 without (the scale counts), the likelihood being that of absolute
// deviations (Hurvich and Tsai, "Regression and time series model selection in small samples",
// Biometrika 76, 1989; "Model selection for least absolute deviations regression in small
// samples", Statistics and Probability Letters 9, 1990). Of 6 points it must leave 12 times less
// deviation, of 8 points 1.8 times, of 5 or fewer no bend is believed. The slope must rise, and
// the points up to the break must be flat: by Theil's estimate they rise by at most a fifth of
// the slope behind it.
bool sb_bend_is_clear(const struct sb_bend *bend, const double *x, const double *y, int n,
                      double *scratch); // room for sb_theil_sen_room(n) values
