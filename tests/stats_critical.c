#include "test.h"

#include "stats/between.h"
#include "stats/critical.h"

static const double pi = 3.14159265358979323846;

static void normal_values_are_the_published_ones(void **state)
{
    (void)state;
    check_close(sb_normal_critical(.5), 0.674489750196082, 1e-13);
    check_close(sb_normal_critical(.95), 1.959963984540054, 1e-13);
    check_close(sb_normal_critical(.99), 2.575829303548901, 1e-13);
    check_close(sb_normal_critical(.999), 3.290526731491926, 1e-11);
}

static void student_values_are_the_published_ones(void **state)
{
    (void)state;
    static const struct {
        int df;
        double at95, at99;
    } table[] = {
        {1, 12.706205, 63.656741}, {2, 4.302653, 9.924843},  {3, 3.182446, 5.840909},
        {4, 2.776445, 4.604095},   {5, 2.570582, 4.032143},  {9, 2.262157, 3.249836},
        {10, 2.228139, 3.169273},  {29, 2.045230, 2.756386}, {30, 2.042272, 2.749996},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        check_close(sb_student_critical(.95, table[i].df), table[i].at95, 1e-6);
        check_close(sb_student_critical(.99, table[i].df), table[i].at99, 1e-6);
    }
}

static void student_inverts_its_simple_cases(void **state)
{
    (void)state;
    for (double level = .05; level < 1; level += .05) {
        check_close(sb_student_critical(level, 1), tan(pi * level / 2), 1e-10);
        check_close(sb_student_critical(level, 2), level * sqrt(2 / (1 - level * level)),
                    1e-10);
    }
    check_close(sb_student_critical(.95, 100000), sb_normal_critical(.95), 1e-4);
}

// P(|T| <= x) by Simpson's rule over the density.
static double student_integral(double x, int df)
{
    const double factor = exp(lgamma((df + 1) / 2.0) - lgamma(df / 2.0)) / sqrt(df * pi);
    const int steps = 2000;
    double sum = 0;
    for (int i = 0; i <= steps; i++) {
        const double t = x * i / steps;
        const int weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
        sum += weight * pow(1 + t * t / df, -(df + 1) / 2.0);
    }
    return 2 * factor * sum * x / steps / 3;
}

static void student_intervals_hold_the_area_under_the_density(void **state)
{
    (void)state;
    for (int df = 2; df <= 40; df++)
        check_close(student_integral(sb_student_critical(.975, df), df), .975, 1e-8);
}

static void processes_give_a_t_interval_over_logarithms(void **state)
{
    (void)state;
    // Logarithms 0, 1, 2: mean 1, standard error 1/sqrt(3).
    const double medians[] = {1, exp(1), exp(2)};
    const struct sb_interval interval = sb_between_processes(medians, 3, .95);
    check_close(interval.point, exp(1), 1e-14);
    check_close(interval.lo, exp(1 - 4.302652729749463 / sqrt(3)), 1e-12);
    check_close(interval.hi, exp(1 + 4.302652729749463 / sqrt(3)), 1e-9);
    assert_int_equal(interval.n, 3);
}

static void one_process_has_no_interval(void **state)
{
    (void)state;
    const double medians[] = {7, 0};
    const struct sb_interval one = sb_between_processes(medians, 1, .95);
    check_close(one.point, 7, 1e-14);
    assert_true(isnan(one.lo) && isnan(one.hi));
    assert_true(isnan(sb_between_processes(medians, 2, .95).point));
    assert_true(isnan(sb_between_processes(medians, 0, .95).point));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_values_are_the_published_ones),
        cmocka_unit_test(student_values_are_the_published_ones),
        cmocka_unit_test(student_inverts_its_simple_cases),
        cmocka_unit_test(student_intervals_hold_the_area_under_the_density),
        cmocka_unit_test(processes_give_a_t_interval_over_logarithms),
        cmocka_unit_test(one_process_has_no_interval),
    };
    return run_tests(tests);
}
