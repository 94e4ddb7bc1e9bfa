// Are paired differences on one side of a shift? Ranks, so that spikes count as large and
// no more.
#pragma once

// What is to be shown: that d lies above the shift, or below it.
enum sb_alternative { SB_GREATER, SB_LESS };

enum { SB_SIGNED_RANK_MAX = 4096 };

// The one-sided p-value of Wilcoxon's signed-rank test: with d symmetric about `shift`, how
// probable is a sum W of the ranks of |d - shift| over the d above it that is at least as large
// (SB_LESS: at most as large) as the one seen? (Wilcoxon, "Individual comparisons by ranking
// methods", Biometrics Bulletin 1(6), 1945; Hollander, Wolfe and Chicken, Nonparametric
// Statistical Methods, 3rd ed., 3.1.)
//
// Equal |d - shift| share the mean of their ranks. Where d is the shift itself it keeps its
// rank, the lowest, and half of that goes to either side. That is Pratt's treatment ("Remarks
// on zeros and ties in the Wilcoxon signed rank procedures", JASA 54, 1959): what zeros add is
// the same for all signs of the others, so that it moves W and its mean alike, and the variance
// is left with the ranks r of the others, sum of r^2 / 4 (Cureton, "The normal approximation to
// the signed-rank sampling distribution when zero differences are present", JASA 62, 1967).
// Nothing but zeros says nothing: p = 1.
//
// Up to 25 differences p is exact, given the ranks, ties and zeros included. Beyond, it is the
// normal approximation with that variance, to which ties bring their own correction, and a
// continuity correction of 1/2. W has lighter tails than the normal distribution, so small
// p-values come out too large: below 0.001 by a factor of at most 2.6 at 26 differences and 1.11
// at 240, down to 0.0001 (tests/stats_signed_rank.c).
//
// n: 1 .. SB_SIGNED_RANK_MAX, else NAN; so where a d is NAN. `scratch` has room for n values.
double sb_signed_rank_p(const double *d, int n, double shift,
                        enum sb_alternative alternative, double *scratch);
