// Samples in the order in which they were measured: how much do they depend on it? Intervals
// take samples as exchangeable; these numbers tell a reader how far they are.
#pragma once

// Lag-1 autocorrelation of the signs of values[i] - centre, in the order they were
// measured: sum of s[i] s[i+1] over sum of s[i]^2; about 0 for independent samples. Over
// 0.3 an interval says little beyond its own run. Signs, so that spikes do not hide it.
// NAN where every value is the centre.
double sb_sign_autocorrelation(const double *values, int n, double centre);

// Lag-1 autocorrelation of the ranks of the values, midranks for equal ones (Wald and Wolfowitz,
// "An exact test for randomness in the non-parametric case based on serial correlation", Annals
// of Mathematical Statistics 14, 1943): sum of (r[i] - m)(r[i+1] - m) over sum of (r[i] - m)^2,
// m being their mean. Near the correlation of the values where these are normal, which that of
// the signs is not, and little moved by spikes. Of n independent values it is about -1/n, give or
// take 1/sqrt(n). NAN where all values are equal. `scratch` has room for 2 n values.
double sb_rank_autocorrelation(const double *values, int n, double *scratch);

// Drift: the range of the medians of the four quarters of the series, over the median of all.
// NAN for n < 4. `scratch` has room for n values.
double sb_drift(const double *values, int n, double *scratch);
