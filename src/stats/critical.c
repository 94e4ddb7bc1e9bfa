// Both distribution functions are closed forms, so their inverses are found by bisection:
// a few dozen evaluations, right to the last digits, and no table to mistype.

#include <math.h>

#include "stats/critical.h"

static const double pi = 3.14159265358979323846;

// P(|Z| <= x)
static double normal_within(double x, int df)
{
    (void)df;
    return erf(x / sqrt(2));
}

// P(|T| <= x): the finite sums of Abramowitz and Stegun, Handbook of Mathematical
// Functions, 26.7.3 (odd df) and 26.7.4 (even df).
static double student_within(double x, int df)
{
    const double angle = atan(x / sqrt(df)), cosine = cos(angle);
    const int odd = df % 2;
    double term = odd ? cosine : 1, sum = 0;
    for (int power = odd; power <= df - 2; power += 2) {
        sum += term;
        term *= cosine * cosine * (power + 1) / (power + 2);
    }
    return odd ? 2 / pi * (angle + sin(angle) * sum) : sin(angle) * sum;
}

static double invert(double (*within)(double x, int df), int df, double level)
{
    double lo = 0, hi = 1;
    while (within(hi, df) < level && hi < 0x1p60) {
        lo = hi;
        hi *= 2;
    }
    for (;;) {
        const double middle = lo + (hi - lo) / 2;
        if (middle <= lo || middle >= hi)
            return middle;
        if (within(middle, df) < level)
            lo = middle;
        else
            hi = middle;
    }
}

double sb_normal_critical(double level)
{
    return invert(normal_within, 0, level);
}

double sb_student_critical(double level, int df)
{
    return invert(student_within, df, level);
}
