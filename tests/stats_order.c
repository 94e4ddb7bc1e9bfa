#include "test.h"

#include "math/random.h"
#include "stats/order.h"

static void sorting_is_ascending_and_keeps_every_value(void **state)
{
    (void)state;
    double values[] = {3, -1, 1e300, 0.5, -INFINITY, 3, -1e-300};
    const double expected[] = {-INFINITY, -1, -1e-300, 0.5, 3, 3, 1e300};
    sb_sort_doubles(values, 7);
    assert_memory_equal(values, expected, sizeof values);
    sb_sort_doubles(NULL, 0);
}

static void median_is_the_middle_value_or_the_mean_of_two(void **state)
{
    (void)state;
    const double values[] = {1, 2, 4, 8};
    check_close(sb_median(values, 3), 2, 0);
    check_close(sb_median(values, 4), 3, 0);
    check_close(sb_median(values, 1), 1, 0);
    const double large[] = {1.5e308, 1.7e308};
    check_close(sb_median(large, 2), 1.6e308, 1e293);
    assert_true(isnan(sb_median(values, 0)));
}

static void quantiles_are_of_type_seven(void **state)
{
    (void)state;
    // R: quantile(c(1, 2, 4, 8), c(0, .05, .25, .5, .9, .95, 1))
    const double values[] = {1, 2, 4, 8};
    const double p[] = {0, .05, .25, .5, .9, .95, 1};
    const double expected[] = {1, 1.15, 1.75, 3, 6.8, 7.4, 8};
    for (int i = 0; i < 7; i++)
        check_close(sb_quantile(values, 4, p[i]), expected[i], 1e-14);
    check_close(sb_quantile(values, 1, .95), 1, 0);
    assert_true(isnan(sb_quantile(values, 0, .5)));
}

// With 1 ... n as samples, the lower bound is the rank itself.
static double rank_at(int n, double level)
{
    double *ranks = malloc((size_t)n * sizeof *ranks);
    for (int i = 0; i < n; i++)
        ranks[i] = i + 1;
    const struct sb_interval interval = sb_median_interval(ranks, n, level);
    if (!isnan(interval.lo))
        check_close(interval.hi, n + 1 - interval.lo, 0);
    assert_int_equal(interval.n, n);
    check_close(interval.point, (n + 1) / 2.0, 0);
    free(ranks);
    return interval.lo;
}

static void median_interval_has_the_ranks_of_published_tables(void **state)
{
    (void)state;
    assert_true(isnan(rank_at(5, .95)));
    check_close(rank_at(6, .95), 1, 0);
    check_close(rank_at(9, .95), 2, 0);
    check_close(rank_at(20, .95), 6, 0);
    check_close(rank_at(50, .95), 18, 0);
    check_close(rank_at(100, .95), 40, 0);
    check_close(rank_at(100, .99), 37, 0);
    check_close(rank_at(4, .875), 1, 0); // covers with 7/8 exactly
    assert_true(isnan(rank_at(1, .95)));
}

static void median_interval_covers_over_all_patterns_and_is_the_narrowest(void **state)
{
    (void)state;
    const double levels[] = {.5, .9, .95, .99};
    for (int n = 2; n <= 14; n++) {
        int below[15] = {0}; // patterns with so many samples under the true median
        for (unsigned pattern = 0; pattern < 1u << n; pattern++) {
            int ones = 0;
            for (int i = 0; i < n; i++)
                ones += pattern >> i & 1;
            below[ones]++;
        }
        for (int l = 0; l < 4; l++) {
            const double found = rank_at(n, levels[l]);
            int narrowest = 0;
            for (int k = 1; k <= n / 2; k++) {
                int covered = 0; // x(k) < median < x(n+1-k)
                for (int ones = k; ones <= n - k; ones++)
                    covered += below[ones];
                if (covered >= levels[l] * (1u << n))
                    narrowest = k;
            }
            if (narrowest == 0)
                assert_true(isnan(found));
            else
                check_close(found, narrowest, 0);
        }
    }
}

// P(Binomial(n, 1/2) < k), from logarithms of factorials.
static long double tail_below(int n, int k)
{
    long double sum = 0;
    for (int j = k - 1; j >= 0 && j > k - 20000; j--)
        sum += expl(lgammal(n + 1.0L) - lgammal(j + 1.0L) - lgammal(n - j + 1.0L) -
                    n * logl(2));
    return sum;
}

static void median_interval_is_exact_for_a_million_samples_too(void **state)
{
    (void)state;
    const int sizes[] = {999, 1074, 1075, 1076, 4000, 20001, 1000000};
    for (int i = 0; i < 7; i++) {
        const int k = (int)rank_at(sizes[i], .99);
        assert_true(tail_below(sizes[i], k) <= .005L);
        assert_true(tail_below(sizes[i], k + 1) > .005L);
    }
}

static void median_of_no_samples_is_unknown(void **state)
{
    (void)state;
    const struct sb_interval interval = sb_median_interval(NULL, 0, .95);
    assert_true(isnan(interval.point) && isnan(interval.lo) && isnan(interval.hi));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sorting_is_ascending_and_keeps_every_value),
        cmocka_unit_test(median_is_the_middle_value_or_the_mean_of_two),
        cmocka_unit_test(quantiles_are_of_type_seven),
        cmocka_unit_test(median_interval_has_the_ranks_of_published_tables),
        cmocka_unit_test(median_interval_covers_over_all_patterns_and_is_the_narrowest),
        cmocka_unit_test(median_interval_is_exact_for_a_million_samples_too),
        cmocka_unit_test(median_of_no_samples_is_unknown),
    };
    return run_tests(tests);
}
