// Order statistics: what is said of the samples of one variant. Nothing is assumed of
// their distribution, and no sample is ever dropped as an outlier: ranks cope with
// spikes.
#pragma once

// An estimate and its confidence interval. lo and hi are NAN where the samples are too
// few for the level asked for, and everything is NAN for no samples at all.
struct sb_interval {
    double point, lo, hi;
    int n; // number of samples
};

// Ascending, in place. Values must not be NAN, which has no rank.
void sb_sort_doubles(double *values, int n);

// The functions below want their values sorted; NAN for n = 0.

// Middle value, or the mean of the middle two.
double sb_median(const double *sorted, int n);

// Quantile of p in [0,1], type 7 of Hyndman and Fan, "Sample quantiles in statistical
// packages", The American Statistician 50(4), 1996 (what R and NumPy do by default):
// linear between the order statistics around place (n - 1) p, counted from 0.
double sb_quantile(const double *sorted, int n, double p);

// The median with an exact interval between two order statistics: the k-th value from
// either end, with the largest k for which 2 P(Binomial(n, 1/2) < k) <= 1 - level. So it
// covers with at least `level`, for any continuous distribution of independent samples
// (David and Nagaraja, Order Statistics, 3rd ed., 7.1; Conover, Practical Nonparametric
// Statistics, 3rd ed., 3.2). Samples of one process tell of that process only.
struct sb_interval sb_median_interval(const double *sorted, int n, double level);
