#include "test.h"

#include "math/random.h"
#include "stats/within.h"

enum { N = 400, TRIES = 400 };

static double gauss(struct sb_random *random)
{
    // Box and Muller 1958.
    const double u = 1 - sb_random_unit(random), v = sb_random_unit(random);
    return sqrt(-2 * log(u)) * cos(6.283185307179586 * v);
}

// Of series with lag-1 correlation `rho` and median 100, how many intervals cover it?
static double coverage(double rho, bool blocks)
{
    struct sb_random random = sb_random_seed(7);
    double values[N], sorted[N];
    int hits = 0;
    for (int t = 0; t < TRIES; t++) {
        double x = gauss(&random);
        for (int i = 0; i < N; i++) {
            x = rho * x + sqrt(1 - rho * rho) * gauss(&random);
            values[i] = sorted[i] = 100 + x;
        }
        sb_sort_doubles(sorted, N);
        const struct sb_interval plain = sb_median_interval(sorted, N, 0.95);
        const struct sb_interval within = sb_within_run(values, N, 0.95, NULL, sorted);
        const struct sb_interval *used = blocks ? &within : &plain;
        hits += used->lo <= 100 && 100 <= used->hi;
    }
    return (double)hits / TRIES;
}

static void independent_samples_keep_the_exact_interval(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    double values[101], sorted[101], scratch[101], rho;
    for (int i = 0; i < 101; i++)
        values[i] = sorted[i] = sb_random_unit(&random);
    sb_sort_doubles(sorted, 101);
    const struct sb_interval plain = sb_median_interval(sorted, 101, 0.95);
    const struct sb_interval within = sb_within_run(values, 101, 0.95, &rho, scratch);
    assert_true(rho < SB_CORRELATED);
    check_close(within.point, plain.point, 0);
    check_close(within.lo, plain.lo, 0);
    check_close(within.hi, plain.hi, 0);
}

static void correlated_samples_are_covered_where_the_plain_interval_fails(void **state)
{
    (void)state;
    assert_true(coverage(0, true) >= 0.93);
    assert_true(coverage(0.6, false) < 0.82);
    assert_true(coverage(0.6, true) > 0.9);
    assert_true(coverage(0.8, true) > coverage(0.8, false) + 0.2);
}

static void a_series_that_drifts_has_a_wide_interval(void **state)
{
    (void)state;
    double values[100], scratch[100], rho;
    for (int i = 0; i < 100; i++)
        values[i] = 100 + i;
    const struct sb_interval within = sb_within_run(values, 100, 0.95, &rho, scratch);
    check_close(within.point, 149.5, 0);
    assert_true(rho > 0.9);
    // 20 blocks with medians 102, 107 …: the 6th and the 15th (David and Nagaraja, 7.1).
    check_close(within.lo, 127, 0);
    check_close(within.hi, 172, 0);
}

static void too_few_blocks_have_no_interval(void **state)
{
    (void)state;
    double values[20], scratch[20];
    for (int i = 0; i < 20; i++)
        values[i] = i;
    const struct sb_interval within = sb_within_run(values, 20, 0.95, NULL, scratch);
    check_close(within.point, 9.5, 0);
    assert_true(isnan(within.lo) && isnan(within.hi));
    assert_true(isnan(sb_within_run(NULL, 0, 0.95, NULL, scratch).point));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(independent_samples_keep_the_exact_interval),
        cmocka_unit_test(correlated_samples_are_covered_where_the_plain_interval_fails),
        cmocka_unit_test(a_series_that_drifts_has_a_wide_interval),
        cmocka_unit_test(too_few_blocks_have_no_interval),
    };
    return run_tests(tests);
}
