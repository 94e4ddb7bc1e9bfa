#include "test.h"

#include "stats/clopper_pearson.h"

// Newcombe, "Two-sided confidence intervals for the single proportion: comparison of seven
// methods", Statistics in Medicine 17, 1998, table I, method 5; and R's binom.test(682, 925).
static void intervals_are_the_published_ones(void **state)
{
    (void)state;
    static const struct {
        int k, n;
        double lo, hi, tolerance;
    } rows[] = {
        {81, 263, .2527, .3676, 5e-5},
        {15, 148, .0578, .1617, 5e-5},
        {0, 20, 0, .1684, 5e-5},
        {1, 29, .0009, .1776, 5e-5},
        {682, 925, .7076683, .7654066, 5e-8},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const struct sb_interval interval = sb_clopper_pearson(rows[r].k, rows[r].n, .95);
        check_close(interval.lo, rows[r].lo, rows[r].tolerance);
        check_close(interval.hi, rows[r].hi, rows[r].tolerance);
        check_close(interval.point, (double)rows[r].k / rows[r].n, 0);
        assert_int_equal(interval.n, rows[r].n);
    }
}

// P(Binomial(n, p) <= k) by n trials one after the other: nothing but sums of products.
static double at_most(int k, int n, double p)
{
    double share[202] = {1}, sum = 0;
    for (int trial = 1; trial <= n; trial++)
        for (int j = trial; j >= 0; j--)
            share[j] = share[j] * (1 - p) + (j > 0 ? share[j - 1] * p : 0);
    for (int j = 0; j <= k; j++)
        sum += share[j];
    return sum;
}

static void bounds_solve_the_equations_that_define_them(void **state)
{
    (void)state;
    static const double levels[] = {.5, .8, .95, .975, .9999};
    for (int n = 1; n <= 200; n += n < 12 ? 1 : 47)
        for (int k = 0; k <= n; k += n < 12 ? 1 : 5)
            for (int l = 0; l < 5; l++) {
                const double tail = 1 - levels[l];
                const double lower = sb_clopper_pearson_lower(k, n, levels[l]);
                const double upper = sb_clopper_pearson_upper(k, n, levels[l]);
                if (k > 0)
                    check_close(1 - at_most(k - 1, n, lower), tail, 1e-12);
                else
                    check_close(lower, 0, 0);
                if (k < n)
                    check_close(at_most(k, n, upper), tail, 1e-12);
                else
                    check_close(upper, 1, 0);
            }
}

// Where none or all happened the equations are powers: (1 - p)^n, p^n.
static void none_of_many_and_all_of_many_have_closed_forms(void **state)
{
    (void)state;
    static const int sizes[] = {1, 10, 500, 100000, 100000000};
    for (int s = 0; s < 5; s++) {
        const int n = sizes[s];
        const double none = -expm1(log(.05) / n);
        check_close(sb_clopper_pearson_upper(0, n, .95) / none, 1, 1e-13);
        check_close(sb_clopper_pearson_lower(n, n, .95), exp(log(.05) / n), 1e-15);
        const double once = -expm1(log1p(-.05) / n); // P(at least one) = 0.05
        check_close(sb_clopper_pearson_lower(1, n, .95) / once, 1, 1e-10);
    }
    check_close(sb_clopper_pearson_upper(0, 500, .95), .006, 5e-5);
}

static void successes_and_failures_mirror(void **state)
{
    (void)state;
    for (int k = 0; k <= 37; k++) {
        const struct sb_interval one = sb_clopper_pearson(k, 37, .9);
        const struct sb_interval other = sb_clopper_pearson(37 - k, 37, .9);
        check_close(one.lo, 1 - other.hi, 1e-14);
        check_close(one.lo, sb_clopper_pearson_lower(k, 37, .95), 1e-15);
        assert_true(one.lo <= one.point && one.point <= one.hi);
    }
}

static void half_of_a_million_is_near_a_half_give_or_take_a_thousandth(void **state)
{
    (void)state;
    const struct sb_interval half = sb_clopper_pearson(500000, 1000000, .95);
    check_close(half.hi - .5, 1.959964 * .5 / 1000, 1e-6); // normal, and half a success
    check_close(.5 - half.lo, 1.959964 * .5 / 1000, 1e-6);
}

static void the_interval_covers_at_least_as_often_as_it_says(void **state)
{
    (void)state;
    for (int percent = 1; percent < 100; percent += 7) {
        const double p = percent / 100.0;
        double covered = 0;
        for (int k = 0; k <= 30; k++) {
            const struct sb_interval interval = sb_clopper_pearson(k, 30, .9);
            if (interval.lo <= p && p <= interval.hi)
                covered += at_most(k, 30, p) - (k > 0 ? at_most(k - 1, 30, p) : 0);
        }
        assert_true(covered >= .9);
    }
}

static void what_is_no_count_has_no_bounds(void **state)
{
    (void)state;
    assert_true(isnan(sb_clopper_pearson_lower(0, 0, .95)));
    assert_true(isnan(sb_clopper_pearson_upper(-1, 5, .95)));
    assert_true(isnan(sb_clopper_pearson_lower(6, 5, .95)));
    assert_true(isnan(sb_clopper_pearson(0, 0, .95).point));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_are_the_published_ones),
        cmocka_unit_test(bounds_solve_the_equations_that_define_them),
        cmocka_unit_test(none_of_many_and_all_of_many_have_closed_forms),
        cmocka_unit_test(successes_and_failures_mirror),
        cmocka_unit_test(half_of_a_million_is_near_a_half_give_or_take_a_thousandth),
        cmocka_unit_test(the_interval_covers_at_least_as_often_as_it_says),
        cmocka_unit_test(what_is_no_count_has_no_bounds),
    };
    return run_tests(tests);
}
