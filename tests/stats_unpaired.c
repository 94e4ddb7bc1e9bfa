// The ratio of two levels that were measured apart, against formulas over the samples themselves
// and against what it covers when many are drawn.
#include "test.h"

#include "math/random.h"
#include "stats/between.h"
#include "stats/critical.h"
#include "stats/unpaired.h"

static struct sb_random chance;

// Box and Muller.
static double normal(void)
{
    const double u = 1 - sb_random_unit(&chance), v = sb_random_unit(&chance);
    return sqrt(-2 * log(u)) * cos(2 * 3.14159265358979323846 * v);
}

static void bounds_at_equal_distances_add_up_like_standard_errors(void **state)
{
    (void)state;
    // Of two normal means the answer is known: sqrt(0.03^2 + 0.04^2) = 0.05.
    const struct sb_interval a = {2, 2 * exp(-.03), 2 * exp(.03), 100};
    const struct sb_interval b = {3, 3 * exp(-.04), 3 * exp(.04), 100};
    const struct sb_interval ratio = sb_unpaired_within(&a, &b);
    check_close(ratio.point, 1.5, 1e-15);
    check_close(ratio.lo, 1.5 * exp(-.05), 1e-14);
    check_close(ratio.hi, 1.5 * exp(.05), 1e-14);
    assert_int_equal(ratio.n, 2);
}

// The lower bound of b / a has to do with the lower one of b and the upper one of a.
static void bounds_that_lean_are_taken_from_the_sides_that_they_come_from(void **state)
{
    (void)state;
    const struct sb_interval a = {1, exp(-.12), exp(.03), 50};
    const struct sb_interval b = {1, exp(-.04), exp(.05), 50};
    const struct sb_interval ratio = sb_unpaired_within(&a, &b);
    check_close(log(ratio.lo), -.05, 1e-14);
    check_close(log(ratio.hi), .13, 1e-14);
}

static void swapping_the_sides_inverts_the_ratio(void **state)
{
    (void)state;
    const struct sb_interval a = {1.1, 1, 1.3, 2}, b = {2.2, 2.1, 2.21, 4};
    const struct sb_interval within[] = {sb_unpaired_within(&a, &b),
                                         sb_unpaired_within(&b, &a)};
    const struct sb_interval between[] = {sb_unpaired_between(&a, &b, .95),
                                          sb_unpaired_between(&b, &a, .95)};
    check_close(within[0].point * within[1].point, 1, 1e-14);
    check_close(within[0].lo * within[1].hi, 1, 1e-14);
    check_close(within[0].hi * within[1].lo, 1, 1e-14);
    check_close(between[0].lo * between[1].hi, 1, 1e-14);
    check_close(between[0].hi * between[1].lo, 1, 1e-14);
}

// Medians of 60 skewed samples: nine in ten near 1, one in ten up to three times as slow.
static struct sb_interval level_of_a_process(void)
{
    double ms[60];
    for (int i = 0; i < 60; i++)
        ms[i] = exp(.03 * normal()) *
                (sb_random_below(&chance, 10) ? 1 : 1 + 2 * sb_random_unit(&chance));
    sb_sort_doubles(ms, 60);
    return sb_median_interval(ms, 60, .95);
}

static void intervals_of_two_medians_cover_their_ratio(void **state)
{
    (void)state;
    enum { TRIES = 4000 };
    int covered = 0;
    chance = sb_random_seed(1);
    for (int i = 0; i < TRIES; i++) {
        const struct sb_interval a = level_of_a_process(), b = level_of_a_process();
        const struct sb_interval ratio = sb_unpaired_within(&a, &b);
        covered += ratio.lo <= 1 && 1 <= ratio.hi;
    }
    // An order statistic's interval of 60 holds with 97.3 %, so this holds with more than 95 %.
    assert_true(covered > .95 * TRIES && covered < .985 * TRIES);
}

// Student's t of two samples, from the samples.
static void check_pooled(const double *a, int na, const double *b, int nb, double level)
{
    const struct sb_interval one = sb_between_processes(a, na, .95),
                             other = sb_between_processes(b, nb, .95);
    const struct sb_interval ratio = sb_unpaired_between(&one, &other, .95);
    double mean_a = 0, mean_b = 0, squares = 0;
    for (int i = 0; i < na; i++)
        mean_a += log(a[i]) / na;
    for (int i = 0; i < nb; i++)
        mean_b += log(b[i]) / nb;
    for (int i = 0; i < na; i++)
        squares += pow(log(a[i]) - mean_a, 2);
    for (int i = 0; i < nb; i++)
        squares += pow(log(b[i]) - mean_b, 2);
    const int df = na + nb - 2;
    const double reach =
        sb_student_critical(level, df) * sqrt(squares / df * (1. / na + 1. / nb));
    check_close(log(ratio.point), mean_b - mean_a, 1e-12);
    check_close(log(ratio.lo), mean_b - mean_a - reach, 1e-11);
    check_close(log(ratio.hi), mean_b - mean_a + reach, 1e-11);
    assert_int_equal(ratio.n, na + nb);
}

static void processes_give_students_t_over_their_medians(void **state)
{
    (void)state;
    double a[8], b[8];
    chance = sb_random_seed(2);
    for (int na = 1; na <= 8; na++)
        for (int nb = na == 1 ? 2 : 1; nb <= 8; nb++) {
            for (int i = 0; i < 8; i++) {
                a[i] = 4 * exp(.1 * normal());
                b[i] = 5 * exp(.02 * normal());
            }
            check_pooled(a, na, b, nb, .95);
        }
}

static void processes_whose_levels_differ_are_covered(void **state)
{
    (void)state;
    enum { TRIES = 4000 };
    int covered = 0, alone = 0;
    chance = sb_random_seed(3);
    for (int i = 0; i < TRIES; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = exp(.1 * normal());
            b[k] = exp(.1 * normal());
        }
        const struct sb_interval one = sb_between_processes(a, 3, .95),
                                 other = sb_between_processes(b, 3, .95),
                                 single = sb_between_processes(b, 1, .95);
        const struct sb_interval ratio = sb_unpaired_between(&one, &other, .95),
                                 mixed = sb_unpaired_between(&one, &single, .95);
        covered += ratio.lo <= 1 && 1 <= ratio.hi;
        alone += mixed.lo <= 1 && 1 <= mixed.hi;
    }
    check_close((double)covered / TRIES, .95, .01);
    check_close((double)alone / TRIES, .95, .01);
}

static void what_is_not_known_has_no_interval(void **state)
{
    (void)state;
    const struct sb_interval good = {1, .9, 1.1, 1}, bare = {1, NAN, NAN, 1},
                             none = {NAN, NAN, NAN, 0}, zero = {0, 0, 0, 3};
    check_close(sb_unpaired_within(&good, &bare).point, 1, 0);
    assert_true(isnan(sb_unpaired_within(&good, &bare).lo));
    assert_true(isnan(sb_unpaired_within(&bare, &good).hi));
    assert_true(isnan(sb_unpaired_within(&good, &none).point));
    assert_true(isnan(sb_unpaired_within(&zero, &good).point));
    check_close(sb_unpaired_between(&good, &bare, .95).point, 1, 0);
    assert_true(isnan(sb_unpaired_between(&good, &bare, .95).lo));
    assert_true(isnan(sb_unpaired_between(&good, &zero, .95).point));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_at_equal_distances_add_up_like_standard_errors),
        cmocka_unit_test(bounds_that_lean_are_taken_from_the_sides_that_they_come_from),
        cmocka_unit_test(swapping_the_sides_inverts_the_ratio),
        cmocka_unit_test(intervals_of_two_medians_cover_their_ratio),
        cmocka_unit_test(processes_give_students_t_over_their_medians),
        cmocka_unit_test(processes_whose_levels_differ_are_covered),
        cmocka_unit_test(what_is_not_known_has_no_interval),
    };
    return run_tests(tests);
}
