// Samples in the order in which they were measured: how much do they depend on it? Intervals
// take samples as exchangeable; these two numbers tell a reader how far they are.
#pragma once

// Lag-1 autocorrelation of the signs of values[i] - centre, in the order they were
// measured: sum of s[i] s[i+1] over sum of s[i]^2; about 0 for independent samples. Over
// 0.3 an interval says little beyond its own run. Signs, so that spikes do not hide it.
// NAN where every value is the centre.
double sb_sign_autocorrelation(const double *values, int n, double centre);

// Drift: the range of the medians of the four quarters of the series, over the median of all.
// NAN for n < 4. `scratch` has room for n values.
double sb_drift(const double *values, int n, double *scratch);
