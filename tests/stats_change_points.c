// Change points against the enumeration of all divisions, and in simulated series.
#include "test.h"

#include "noise.h"
#include "stats/change_points.h"

enum { MOST = SB_CHANGE_VALUES_MAX };
static double values[MOST + 1], scratch[4 * MOST + 1];
static struct sb_segment segment[MOST];

static const struct sb_change_rule anything = {.min_length = 5, .min_magnitude = 0};

static int divide(int n, const struct sb_change_rule *rule)
{
    const int count = sb_change_points(values, n, rule, scratch, segment);
    int at = 0;
    for (int s = 0; s < count; s++) { // whatever is found covers the series, in order
        assert_int_equal(segment[s].start, at);
        assert_true(segment[s].n >= rule->min_length || count == 1);
        at += segment[s].n;
    }
    assert_int_equal(at, count ? n : 0);
    assert_true(count <= sb_segments_max(n > 0 ? n : 1, rule));
    return count;
}

// --- by definition ------------------------------------------------------------------------

static double median_of(const double *y, int n)
{
    double sorted[16];
    memcpy(sorted, y, (size_t)n * sizeof *y);
    sb_sort_doubles(sorted, n);
    return sb_median(sorted, n);
}

static double deviation_of(const double *y, int n)
{
    const double median = median_of(y, n);
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fabs(y[i] - median);
    return sum;
}

// The least of all ways to divide y[0 .. n-1] into segments of at least `shortest`.
static double enumerated_least(const double *y, int n, int shortest, double penalty)
{
    double least = deviation_of(y, n) + penalty;
    for (int first = shortest; first + shortest <= n; first++)
        least =
            fmin(least, deviation_of(y, first) + penalty +
                            enumerated_least(y + first, n - first, shortest, penalty));
    return least;
}

static void no_division_has_less_deviation_and_penalty(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    int divided = 0;
    for (int trial = 0; trial < 400; trial++) {
        const int n = 2 + trial % 15, shortest = 2 + trial % 3;
        const struct sb_change_rule rule = {.min_length = shortest, .min_magnitude = 0};
        double y[16], apart[16], sum = 0;
        for (int i = 0; i < n; i++) {
            const int step = (i >= n / 3) + (i >= n / 2) * (trial % 4);
            values[i] = exp(0.1 * step + 0.01 * normal_noise(&random));
            y[i] = log(values[i]);
        }
        for (int i = 1; i < n; i++)
            apart[i - 1] = fabs(y[i] - y[i - 1]);
        const double penalty = 2 * median_of(apart, n - 1) / sqrt(2) * (log(n) + 2);
        const int count = divide(n, &rule);
        for (int s = 0; s < count; s++)
            sum += deviation_of(y + segment[s].start, segment[s].n) + penalty;
        check_close(sum, enumerated_least(y, n, shortest, penalty), 1e-12);
        divided += count > 1;
    }
    assert_in_range(divided, 100, 350); // there was something to choose
}

// --- synthetic series ---------------------------------------------------------------------

static void steps_without_noise_are_found_where_they_are(void **state)
{
    (void)state;
    const struct sb_change_rule rule = sb_change_rule_default();
    for (int i = 0; i < 40; i++)
        values[i] = i < 10 ? 1 : i < 25 ? 1.03 : 0.99;
    assert_int_equal(divide(40, &rule), 3);
    assert_int_equal(segment[1].start, 10);
    assert_int_equal(segment[2].start, 25);
    check_close(segment[0].level.point, 1, 0);
    check_close(segment[1].level.lo, 1.03, 0);
    check_close(segment[2].level.hi, 0.99, 0);
    check_close(segment[0].step, 1, 0);
    check_close(segment[1].step, 1.03, 1e-15);
    check_close(segment[2].step, 0.99 / 1.03, 1e-15);
    check_close(segment[2].since_first, 0.99, 1e-15);
}

static double noise_of_kind(struct sb_random *random, int kind)
{
    const double u = sb_random_unit(random) - 0.5;
    switch (kind) {
    case 0:
        return normal_noise(random);
    case 1:
        return sqrt(12) * u;
    case 2: // Laplace
        return (u < 0 ? 1 : -1) * log1p(-2 * fabs(u)) / sqrt(2);
    case 3: { // Student's t with 3 degrees of freedom
        double squares = 0;
        for (int i = 0; i < 3; i++)
            squares += pow(normal_noise(random), 2);
        return normal_noise(random) / sqrt(squares / 3);
    }
    default:
        return spiky_noise(random);
    }
}

static void noise_has_no_change_points_in_95_of_100_series(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    static const int sizes[] = {20, 50, 150};
    const struct sb_change_rule standard = sb_change_rule_default();
    enum { TRIALS = 500 };
    for (int kind = 0; kind < 5; kind++)
        for (int s = 0; s < 3; s++) {
            int divided = 0, by_two_percent = 0;
            for (int trial = 0; trial < TRIALS; trial++) {
                for (int i = 0; i < sizes[s]; i++)
                    values[i] = exp(0.005 * noise_of_kind(&random, kind));
                divided += divide(sizes[s], &anything) > 1;
                by_two_percent += divide(sizes[s], &standard) > 1;
            }
            assert_in_range(divided, 0, TRIALS / 20);
            assert_in_range(by_two_percent, 0, TRIALS / 100);
        }
}

static void steps_of_three_deviations_are_found_within_two_commits(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(7);
    int near = 0;
    for (int trial = 0; trial < 400; trial++) {
        const double step = trial % 2 ? 0.015 : -0.015;
        for (int i = 0; i < 60; i++)
            values[i] = exp(0.005 * normal_noise(&random) + (i >= 45 ? step : 0));
        if (divide(60, &anything) == 2 && abs(segment[1].start - 45) <= 2) {
            check_close(log(segment[1].step), step, 0.006);
            near++;
        }
    }
    assert_in_range(near, 380, 400);
}

static void wild_values_make_no_segment_and_hide_no_step(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(11);
    for (int trial = 0; trial < 200; trial++) {
        for (int i = 0; i < 60; i++)
            values[i] = exp(0.005 * normal_noise(&random) + (i >= 30 ? 0.05 : 0));
        // Two in a row are fewer than half of five.
        for (int w = 0; w < 4; w++) {
            const int at = 3 + 15 * w + (int)sb_random_below(&random, 8);
            values[at] *= w % 2 ? 100 : 0.1;
            values[at + 1] *= w % 2 ? 100 : 0.1;
        }
        const struct sb_change_rule rule = sb_change_rule_default();
        assert_int_equal(divide(60, &rule), 2);
        assert_true(abs(segment[1].start - 30) <= 2);
    }
    for (int last = 53; last <= 55; last++) { // wild from 50 on
        for (int i = 0; i < 60; i++)
            values[i] = i >= 50 && i < last ? 2 : 1;
        assert_int_equal(divide(60, &anything), last < 53 ? 1 : 3);
    }
    values[52] = values[53] = values[54] = 1;
    assert_int_equal(divide(60, &anything), 1);
}

static void scaling_scales_the_levels_and_nothing_else(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(13);
    static const double factors[] = {0x1p-40, 3.7e5, 1.0 / 3};
    static struct sb_segment before[MOST];
    for (int trial = 0; trial < 60; trial++) {
        for (int i = 0; i < 120; i++)
            values[i] = exp(0.005 * normal_noise(&random) + 0.02 * (i / 25));
        const int count = divide(120, &anything);
        memcpy(before, segment, sizeof before);
        for (int i = 0; i < 120; i++)
            values[i] *= factors[trial % 3];
        assert_int_equal(divide(120, &anything), count);
        for (int s = 0; s < count; s++) {
            assert_int_equal(segment[s].start, before[s].start);
            check_close(segment[s].level.point / factors[trial % 3],
                        before[s].level.point, 1e-14);
            check_close(segment[s].step, before[s].step, 1e-14);
        }
    }
}

// Ten steps of 0.5 %, none of which reaches the 2 % that a change must have.
static void a_creep_of_small_steps_is_marked(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(17);
    const struct sb_change_rule rule = sb_change_rule_default();
    for (int length = 5; length <= 20; length += 5)
        for (int trial = 0; trial < 50; trial++) {
            const int n = 11 * length;
            for (int i = 0; i < n; i++)
                values[i] = exp(0.005 * normal_noise(&random)) * pow(1.005, i / length);
            const int count = divide(n, &rule);
            assert_in_range(count, 2, 3);
            assert_true(segment[count - 1].since_first > 1.02);
        }
    for (int i = 0; i < 60; i++)
        values[i] = pow(1.005, i / 15); // three steps: 1.5 % in all
    assert_int_equal(divide(60, &rule), 1);
    assert_int_equal(divide(60, &anything), 4);
}

static void a_change_has_the_least_magnitude_up_and_down(void **state)
{
    (void)state;
    for (int down = 0; down < 2; down++) {
        for (int i = 0; i < 40; i++)
            values[i] = (i < 20) == down ? 1.02 : 1;
        const struct sb_change_rule less = {5, 0.0199}, more = {5, 0.0201};
        assert_int_equal(divide(40, &less), 2);
        assert_int_equal(divide(40, &more), 1);
        check_close(segment[0].level.point, 1.01, 1e-15);
    }
    const struct sb_change_rule standard = sb_change_rule_default();
    for (int i = 0; i < 45; i++)
        values[i] = i < 15 ? 1 : i < 30 ? 1.01 : 0.9;
    assert_int_equal(divide(45, &standard), 2);
    assert_int_equal(segment[1].start, 30);
    check_close(segment[1].step, 0.9 / 1.005, 1e-15);
}

static void short_and_impossible_series_have_one_segment_or_none(void **state)
{
    (void)state;
    for (int i = 0; i <= MOST; i++)
        values[i] = i < 2 ? 1 : 9;
    for (int n = 1; n < 10; n++) // no two segments of five
        assert_int_equal(divide(n, &anything), 1);
    assert_int_equal(divide(0, &anything), 0);
    assert_int_equal(divide(MOST + 1, &anything), 0);
    static const double none[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        values[7] = none[i];
        assert_int_equal(divide(20, &anything), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_division_has_less_deviation_and_penalty),
        cmocka_unit_test(steps_without_noise_are_found_where_they_are),
        cmocka_unit_test(noise_has_no_change_points_in_95_of_100_series),
        cmocka_unit_test(steps_of_three_deviations_are_found_within_two_commits),
        cmocka_unit_test(wild_values_make_no_segment_and_hide_no_step),
        cmocka_unit_test(scaling_scales_the_levels_and_nothing_else),
        cmocka_unit_test(a_creep_of_small_steps_is_marked),
        cmocka_unit_test(a_change_has_the_least_magnitude_up_and_down),
        cmocka_unit_test(short_and_impossible_series_have_one_segment_or_none),
    };
    return run_tests(tests);
}
