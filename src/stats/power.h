// How many pairs a question takes, and how small an effect some pairs can show: for planning
// and reports, by the normal approximation. No verdict depends on it.
#pragma once

// s = 1.4826 median |x - median|: the standard deviation where values are normal, and hardly
// moved by spikes (Rousseeuw and Croux, "Alternatives to the median absolute deviation", JASA
// 88, 1993). 0 where more than half of the values are equal; NAN for n < 1. `scratch` has room
// for n values.
double sb_robust_spread(const double *values, int n, double *scratch);

// All below is for Wilcoxon's signed-rank test and the estimate that belongs to it, for n
// differences of that spread. They need pi/3 as many as means of normal differences do (Hodges
// and Lehmann, "The efficiency of some nonparametric competitors of the t-test", Annals of
// Mathematical Statistics 27, 1956), so the spread counts sqrt(pi/3) times: 1.02.

// The effect beyond the shift that is found with probability `power`, tested one-sided at
// `alpha`: (z[1-alpha] + z[power]) 1.02 s / sqrt(n). `power` from 0.5 to below 1.
double sb_detectable_effect(double spread, int n, double alpha, double power);

// … the probability with which such an effect is found, by the same …
double sb_detection_power(double spread, int n, double alpha, double effect);

// … and how many differences an effect takes, at least 1; INT_MAX where it takes more, or is
// not above 0.
int sb_pairs_to_detect(double spread, double effect, double alpha, double power);

// How many differences an interval of this half-width takes at `level`, two-sided:
// (z 1.02 s / half_width)^2, rounded up; at least 1, at most INT_MAX.
int sb_pairs_for_interval(double spread, double half_width, double level);
