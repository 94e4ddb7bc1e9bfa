#include "test.h"

#include "math/random.h"
#include "stats/order.h"
#include "stats/paired.h"
#include "stats/series.h"

enum { MOST = 600 };
static double a[MOST], b[MOST], scratch[MOST];

// Every Walsh average, listed and sorted; *count of them. The caller frees.
static double *listed_walsh(int n, int *count)
{
    double *averages = malloc((size_t)n * (size_t)(n + 1) / 2 * sizeof *averages);
    *count = 0;
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++)
            averages[(*count)++] = (log(b[i] / a[i]) + log(b[j] / a[j])) / 2;
    sb_sort_doubles(averages, *count);
    return averages;
}

static void fill(struct sb_random *random, int n, int ties)
{
    for (int i = 0; i < n; i++) {
        a[i] = 1e6 + (double)sb_random_below(random, ties ? 3 : 100000);
        b[i] = 1e6 + (double)sb_random_below(random, ties ? 3 : 100000);
    }
}

static void ratio_and_bounds_are_the_very_listed_walsh_averages(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    const int sizes[] = {6, 7, 8, 15, 30, 31, 60, 240, 599};
    for (int s = 0; s < 9; s++)
        for (int ties = 0; ties < 2; ties++) {
            const int n = sizes[s];
            int count;
            fill(&random, n, ties);
            double *walsh = listed_walsh(n, &count);
            const double z = 1.959963984540054;
            const int rank = (int)floor(n * (n + 1) / 4.0 -
                                        z * sqrt(n * (n + 1) * (2.0 * n + 1) / 24));
            const struct sb_interval ratio = sb_paired_ratio(a, b, n, .95, scratch);
            check_close(ratio.point, exp(sb_median(walsh, count)), 1e-15);
            assert_true(rank >= 1);
            check_close(ratio.lo, exp(walsh[rank - 1]), 0);
            check_close(ratio.hi, exp(walsh[count - rank]), 0);
            assert_int_equal(ratio.n, n);
            free(walsh);
        }
}

static void equal_pairs_have_ratio_one_exactly(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++)
        a[i] = b[i] = 1000 + i;
    const struct sb_interval ratio = sb_paired_ratio(a, b, 20, .95, scratch);
    check_close(ratio.point, 1, 0);
    check_close(ratio.lo, 1, 0);
    check_close(ratio.hi, 1, 0);
}

static void pairing_cancels_what_both_suffer(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++) {
        a[i] = 1e6 * (1 + i % 7); // the level jumps up to sevenfold
        b[i] = 1.03 * a[i];
    }
    b[11] *= 50; // and one spike
    const struct sb_interval ratio = sb_paired_ratio(a, b, 40, .95, scratch);
    check_close(ratio.point, 1.03, 1e-12);
    check_close(ratio.lo, 1.03, 1e-12);
    check_close(ratio.hi, 1.03, 1e-12);
    b[11] /= 50;
    const struct sb_interval inverse = sb_paired_ratio(b, a, 40, .95, scratch);
    check_close(inverse.point, 1 / 1.03, 1e-12);
    check_close(inverse.lo, 1 / 1.03, 1e-12);
    check_close(inverse.hi, 1 / 1.03, 1e-12);
}

static void swapping_the_sides_inverts_the_ratio(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    fill(&random, 33, 0);
    const struct sb_interval ratio = sb_paired_ratio(a, b, 33, .95, scratch);
    const struct sb_interval swapped = sb_paired_ratio(b, a, 33, .95, scratch);
    check_close(swapped.point, 1 / ratio.point, 1e-14);
    check_close(swapped.lo, 1 / ratio.hi, 1e-14);
    check_close(swapped.hi, 1 / ratio.lo, 1e-14);
}

// The signed-rank statistic takes each rank with probability 1/2: its distribution by
// convolution. The C-th Walsh average from either end covers unless fewer than C of them
// lie on one side, that is unless the statistic is under C.
static double exact_coverage(int n, int rank)
{
    static double p[1000];
    const int most = n * (n + 1) / 2;
    memset(p, 0, sizeof p);
    p[0] = 1;
    for (int r = 1; r <= n; r++)
        for (int sum = most; sum >= 0; sum--)
            p[sum] = (p[sum] + (sum >= r ? p[sum - r] : 0)) / 2;
    double below = 0;
    for (int sum = 0; sum < rank; sum++)
        below += p[sum];
    return 1 - 2 * below;
}

static void interval_covers_by_the_exact_signed_rank_distribution(void **state)
{
    (void)state;
    const double levels[] = {.9, .95, .99, 1 - .05 / 7};
    for (int n = 1; n <= 40; n++)
        for (int l = 0; l < 4; l++) {
            // d = 1, 2, 4 ... has no equal Walsh averages, so a bound tells its rank.
            int count;
            for (int i = 0; i < n; i++) {
                a[i] = 1;
                b[i] = exp(ldexp(1, i - 34));
            }
            const struct sb_interval ratio = sb_paired_ratio(a, b, n, levels[l], scratch);
            if (isnan(ratio.lo)) {
                // Rounding to the safe side may give up to n = 10 at these levels.
                assert_true(exact_coverage(n, 1) < levels[l] || n <= 10);
                continue;
            }
            double *walsh = listed_walsh(n, &count);
            int rank = 1;
            while (exp(walsh[rank - 1]) < ratio.lo)
                rank++;
            assert_true(exact_coverage(n, rank) >= levels[l]);
            assert_true(exact_coverage(n, rank + 5) < levels[l]);
            free(walsh);
        }
}

static void too_few_or_impossible_pairs_have_no_interval(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(7);
    fill(&random, 6, 0);
    assert_true(isnan(sb_paired_ratio(a, b, 5, .95, scratch).lo));
    assert_false(isnan(sb_paired_ratio(a, b, 5, .95, scratch).point));
    assert_false(isnan(sb_paired_ratio(a, b, 6, .95, scratch).lo));
    a[2] = 0;
    assert_true(isnan(sb_paired_ratio(a, b, 6, .95, scratch).point));
    assert_true(isnan(sb_paired_ratio(a, b, 0, .95, scratch).point));
}

static void sign_autocorrelation_tells_runs_from_alternation(void **state)
{
    (void)state;
    const double alternating[] = {1, 9, 1, 9, 1, 9, 1, 9};
    const double runs[] = {1, 1, 1, 1, 9, 9, 9, 9};
    const double spike[] = {1, 1, 1, 1, 9, 9, 9, 1e9};
    const double tied[] = {1, 5, 9, 9};
    check_close(sb_sign_autocorrelation(alternating, 8, 5), -7 / 8.0, 0);
    check_close(sb_sign_autocorrelation(runs, 8, 5), 5 / 8.0, 0);
    check_close(sb_sign_autocorrelation(spike, 8, 5), 5 / 8.0, 0);
    check_close(sb_sign_autocorrelation(tied, 4, 5), 1 / 3.0, 1e-15);
    assert_true(isnan(sb_sign_autocorrelation(runs, 3, 1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratio_and_bounds_are_the_very_listed_walsh_averages),
        cmocka_unit_test(equal_pairs_have_ratio_one_exactly),
        cmocka_unit_test(pairing_cancels_what_both_suffer),
        cmocka_unit_test(swapping_the_sides_inverts_the_ratio),
        cmocka_unit_test(interval_covers_by_the_exact_signed_rank_distribution),
        cmocka_unit_test(too_few_or_impossible_pairs_have_no_interval),
        cmocka_unit_test(sign_autocorrelation_tells_runs_from_alternation),
    };
    return run_tests(tests);
}
