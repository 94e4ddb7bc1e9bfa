// The signed-rank test against the enumeration of all signs, printed tables, and simulation.
#include "test.h"

#include "math/random.h"
#include "stats/signed_rank.h"

enum { MOST = SB_SIGNED_RANK_MAX };
static double d[MOST], scratch[MOST];

// Wilcoxon's W by its definition, zeros half to either side.
static double rank_sum_above(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double rank = 0.5;
        for (int j = 0; j < n; j++)
            rank += fabs(x[j]) < fabs(x[i]) ? 1 : fabs(x[j]) > fabs(x[i]) ? 0 : 0.5;
        sum += x[i] > 0 ? rank : x[i] < 0 ? 0 : rank / 2;
    }
    return sum;
}

// Over all 2^n ways to sign |x|: the share whose W is on this side of the one seen, or at it.
static double enumerated_p(const double *x, int n, enum sb_alternative alternative)
{
    double turned[16];
    int count = 0;
    for (unsigned signs = 0; signs < 1u << n; signs++) {
        for (int i = 0; i < n; i++)
            turned[i] = signs >> i & 1 ? x[i] : -x[i];
        const double excess = rank_sum_above(turned, n) - rank_sum_above(x, n);
        count += alternative == SB_GREATER ? excess >= 0 : excess <= 0;
    }
    return ldexp(count, -n);
}

static void p_is_the_share_of_all_signs_with_ties_and_zeros_too(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(11);
    for (int n = 1; n <= 10; n++)
        for (int trial = 0; trial < 24; trial++) {
            const int values = trial % 3 == 0 ? 1000 : trial % 3 == 1 ? 9 : 3;
            for (int i = 0; i < n; i++)
                d[i] = (double)sb_random_below(&random, (uint64_t)values) -
                       (values - 1) / 2; // integers, 0 among them
            for (int side = SB_GREATER; side <= SB_LESS; side++)
                check_close(sb_signed_rank_p(d, n, 0, side, scratch),
                            enumerated_p(d, n, side), 1e-15);
        }
}

// Hollander, Wolfe and Chicken, table A.4; McCornack, "Extended tables of the Wilcoxon matched
// pair signed rank statistic", JASA 60, 1965: the largest w with P(W <= w) at most the level.
static void critical_values_are_those_of_the_printed_tables(void **state)
{
    (void)state;
    static const struct {
        int n, w;
        double level;
    } table[] = {
        {5, 0, .05},    {6, 2, .05},    {6, 0, .025},   {7, 3, .05},    {7, 0, .01},
        {8, 5, .05},    {8, 3, .025},   {8, 0, .005},   {10, 10, .05},  {10, 8, .025},
        {10, 5, .01},   {10, 3, .005},  {15, 30, .05},  {15, 25, .025}, {15, 19, .01},
        {15, 15, .005}, {20, 60, .05},  {20, 52, .025}, {20, 43, .01},  {20, 37, .005},
        {25, 100, .05}, {25, 89, .025}, {25, 76, .01},  {25, 68, .005},
    };
    for (size_t t = 0; t < sizeof table / sizeof *table; t++)
        for (int above = 0; above < 2; above++) {
            // Ranks from the largest down are put above the shift until they make up w.
            int left = table[t].w + above;
            for (int i = table[t].n; i >= 1; i--) {
                d[i - 1] = i <= left ? 7 + i : 7 - i;
                left -= i <= left ? i : 0;
            }
            assert_int_equal(left, 0);
            const double p = sb_signed_rank_p(d, table[t].n, 7, SB_LESS, scratch);
            assert_int_equal(p <= table[t].level, !above);
        }
}

// Of n distinct ranks: P(W >= w) for all w, by convolution.
static void convolve(int n, double *tail)
{
    const int most = n * (n + 1) / 2;
    memset(tail, 0, (size_t)(most + 1) * sizeof *tail);
    tail[0] = 1;
    for (int r = 1; r <= n; r++)
        for (int w = most; w >= 0; w--)
            tail[w] = (tail[w] + (w >= r ? tail[w - r] : 0)) / 2;
    for (int w = most; w > 0; w--)
        tail[w - 1] += tail[w];
}

static void the_normal_approximation_is_near_the_exact_p_and_on_the_safe_side(
    void **state)
{
    (void)state;
    static double tail[240 * 241 / 2 + 1];
    static const int sizes[] = {26, 30, 60, 120, 240};
    for (int s = 0; s < 5; s++) {
        const int n = sizes[s], most = n * (n + 1) / 2;
        convolve(n, tail);
        for (int w = 0; w <= most; w += 1 + n / 60) {
            int left = w;
            for (int i = n; i >= 1; i--) {
                d[i - 1] = i <= left ? i : -i;
                left -= i <= left ? i : 0;
            }
            const double p = sb_signed_rank_p(d, n, 0, SB_GREATER, scratch);
            check_close(p, tail[w], 4e-3);
            assert_true(p >= tail[w] || tail[w] > 0.02);
            if (tail[w] > 1e-4)
                assert_true(p <= tail[w] * (n < 60 ? 2.6 : n < 240 ? 1.5 : 1.11));
        }
    }
}

static void beyond_25_ties_and_zeros_have_the_variance_of_their_signs(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    enum { N = 40, TRIALS = 20000 };
    int beyond = 0;
    for (int i = 0; i < N; i++)
        d[i] = i % 5 == 0 ? 0 : (1 + i % 4) * (i % 3 == 0 ? -1 : 1);
    const double p = sb_signed_rank_p(d, N, 0, SB_GREATER, scratch);
    const double seen = rank_sum_above(d, N);
    for (int trial = 0; trial < TRIALS; trial++) {
        double turned[N];
        for (int i = 0; i < N; i++)
            turned[i] = sb_random_below(&random, 2) ? d[i] : -d[i];
        beyond += rank_sum_above(turned, N) >= seen;
    }
    check_close(p, (double)beyond / TRIALS, 0.01);
    check_close(p + sb_signed_rank_p(d, N, 0, SB_LESS, scratch), 1, 0.05);
}

static void under_the_null_p_is_uniform_and_never_smaller(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(17);
    static const int sizes[] = {8, 15, 25, 26, 60};
    static const double levels[] = {.01, .05, .25, .5};
    enum { TRIALS = 4000 };
    for (int s = 0; s < 5; s++) {
        int below[4] = {0};
        for (int trial = 0; trial < TRIALS; trial++) {
            for (int i = 0; i < sizes[s]; i++) {
                const double u = sb_random_unit(&random) - 0.5;
                d[i] = 0.02 + u * u * u; // spikes, and symmetric
            }
            const double p = sb_signed_rank_p(d, sizes[s], .02, trial % 2, scratch);
            for (int l = 0; l < 4; l++)
                below[l] += p <= levels[l];
        }
        for (int l = 0; l < 4; l++) {
            const double share = (double)below[l] / TRIALS;
            const double error = sqrt(levels[l] * (1 - levels[l]) / TRIALS);
            assert_true(share <= levels[l] + 3.5 * error);
            assert_true(share >= levels[l] - 3.5 * error - 0.02); // 8 pairs are coarse
        }
    }
}

// Pratt's reason to keep zeros: dropping them, p may fall where every difference does.
static void a_higher_shift_never_makes_above_more_likely(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(29);
    for (int trial = 0; trial < 300; trial++) {
        const int n = 5 + trial % 8;
        double before = 0;
        for (int i = 0; i < n; i++)
            d[i] = (double)sb_random_below(&random, 12);
        for (int shift = -2; shift <= 26;
             shift++) { // by halves: at the values and between
            const double p = sb_signed_rank_p(d, n, shift / 2.0, SB_GREATER, scratch);
            assert_true(p >= before - 1e-15);
            before = p;
        }
        check_close(before, 1, 1e-15);
    }
}

static void sides_mirror_and_limits_hold(void **state)
{
    (void)state;
    for (int i = 0; i < MOST; i++)
        d[i] = i % 2 ? 3 : -1;
    check_close(sb_signed_rank_p(d, 12, 1, SB_GREATER, scratch),
                sb_signed_rank_p(d, 12, 1, SB_LESS, scratch), 0);
    check_close(sb_signed_rank_p(d, MOST, 1, SB_GREATER, scratch), .5, 1e-3);
    assert_true(sb_signed_rank_p(d, MOST, 0.5, SB_GREATER, scratch) < 1e-100);
    assert_true(isnan(sb_signed_rank_p(d, MOST + 1, 0, SB_LESS, scratch)));
    assert_true(isnan(sb_signed_rank_p(d, 0, 0, SB_LESS, scratch)));
    for (int i = 0; i < 30; i++)
        d[i] = 5;
    check_close(sb_signed_rank_p(d, 20, 5, SB_GREATER, scratch), 1, 1e-15);
    check_close(sb_signed_rank_p(d, 30, 5, SB_LESS, scratch), 1, 1e-15);
    check_close(sb_signed_rank_p(d, 20, 4, SB_GREATER, scratch), ldexp(1, -20), 1e-20);
    d[7] = NAN;
    assert_true(isnan(sb_signed_rank_p(d, 30, 5, SB_LESS, scratch)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(p_is_the_share_of_all_signs_with_ties_and_zeros_too),
        cmocka_unit_test(critical_values_are_those_of_the_printed_tables),
        cmocka_unit_test(
            the_normal_approximation_is_near_the_exact_p_and_on_the_safe_side),
        cmocka_unit_test(beyond_25_ties_and_zeros_have_the_variance_of_their_signs),
        cmocka_unit_test(under_the_null_p_is_uniform_and_never_smaller),
        cmocka_unit_test(a_higher_shift_never_makes_above_more_likely),
        cmocka_unit_test(sides_mirror_and_limits_hold),
    };
    return run_tests(tests);
}
