// Lines and bends against enumeration: every order of the ranks, every slope, every break.
#include "test.h"

#include "math/random.h"
#include "stats/theil_sen.h"

enum { MOST = 64 };
static double x[MOST], y[MOST];
static double scratch[MOST * MOST];

static void swap(double *a, double *b)
{
    const double t = *a;
    *a = *b;
    *b = t;
}

// Of all orders of 0 .. n-1 over the given x: how many have just k discordant pairs.
static void enumerate(const double *at, double *rank, int n, int fixed, double *count)
{
    if (fixed < n) {
        for (int i = fixed; i < n; i++) {
            swap(&rank[fixed], &rank[i]);
            enumerate(at, rank, n, fixed + 1, count);
            swap(&rank[fixed], &rank[i]);
        }
        return;
    }
    int discordant = 0;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            discordant += at[i] < at[j] && rank[i] > rank[j];
    count[discordant]++;
}

// The largest M with 2 P(D < M) <= 1 - level, by the definition.
static int enumerated_rank(const double *at, int n, double level)
{
    double count[MOST] = {0}, rank[MOST], all = 0, sum = 0;
    int m = 0;
    for (int i = 0; i < n; i++)
        rank[i] = i;
    enumerate(at, rank, n, 0, count);
    for (int k = 0; k < MOST; k++)
        all += count[k];
    while (2 * (sum + count[m]) <= (1 - level) * all * (1 + 1e-12))
        sum += count[m++];
    return m;
}

static int list_slopes(int n, double *slope)
{
    int count = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            if (x[i] < x[j])
                slope[count++] = (y[j] - y[i]) / (x[j] - x[i]);
    sb_sort_doubles(slope, count);
    return count;
}

static void slope_and_interval_are_the_listed_slopes_at_the_enumerated_rank(void **state)
{
    (void)state;
    static const double places[][8] = {
        {0, 1, 2, 3},
        {1, 2, 4, 8, 16},
        {1, 2, 4, 8, 12, 16},
        {0, 1, 2, 3, 4, 5, 6},
        {1, 2, 4, 8, 12, 16, 24, 32},
        {1, 1, 2, 2, 3, 3},
        {1, 1, 1, 2, 2, 3, 4},
        {1, 1, 1, 1, 5, 5, 5, 5},
    };
    static const int sizes[] = {4, 5, 6, 7, 8, 6, 7, 8};
    static const double levels[] = {0.8, 0.9, 0.95, 0.99};
    struct sb_random random = sb_random_seed(11);
    double slope[MOST];
    for (int p = 0; p < 8; p++)
        for (int l = 0; l < 4; l++) {
            const int n = sizes[p], rank = enumerated_rank(places[p], n, levels[l]);
            for (int i = 0; i < n; i++) {
                x[i] = places[p][i];
                y[i] = 3 + 0.5 * x[i] + 1e-3 * (double)sb_random_below(&random, 1000);
            }
            const int count = list_slopes(n, slope);
            const struct sb_line line = sb_theil_sen(x, y, n, levels[l], scratch);
            check_close(line.slope.point, sb_median(slope, count), 1e-15);
            assert_int_equal(line.slope.n, count);
            if (rank == 0) {
                assert_true(isnan(line.slope.lo) && isnan(line.slope.hi));
                continue;
            }
            check_close(line.slope.lo, slope[rank - 1], 1e-15);
            check_close(line.slope.hi, slope[count - rank], 1e-15);
        }
}

// Sen's own example needs ranks of Kendall's table: n = 4 has none at 95 %, n = 5 the outermost.
static void ranks_are_those_of_kendalls_table(void **state)
{
    (void)state;
    static const int rank[] = {0, 0, 0, 0, 0, 1, 2, 4, 6, 9, 12};
    for (int n = 4; n <= 10; n++) {
        double slope[MOST];
        for (int i = 0; i < n; i++) {
            x[i] = i;
            y[i] = i * i * i; // all slopes differ
        }
        const int count = list_slopes(n, slope);
        const struct sb_line line = sb_theil_sen(x, y, n, 0.95, scratch);
        if (rank[n] == 0)
            assert_true(isnan(line.slope.lo));
        else
            check_close(line.slope.lo, slope[rank[n] - 1], 1e-12);
        assert_int_equal(count, n * (n - 1) / 2);
    }
}

static void the_line_is_exact_and_bears_a_quarter_of_wild_points(void **state)
{
    (void)state;
    for (int i = 0; i < 16; i++) {
        x[i] = i;
        y[i] = 7 - 0.25 * i;
    }
    y[3] = 1e9;
    y[8] = -1e9;
    y[11] = 40;
    const struct sb_line line = sb_theil_sen(x, y, 16, 0.95, scratch);
    check_close(line.slope.point, -0.25, 1e-12);
    check_close(line.intercept, 7, 1e-12);
}

// Beyond 18 points the normal approximation: it must be near the exact one at its border.
static void the_interval_covers_and_does_not_jump_where_the_approximation_begins(
    void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    static const int sizes[] = {6, 12, 18, 19, 30};
    for (int s = 0; s < 5; s++) {
        int covered = 0;
        for (int trial = 0; trial < 1000; trial++) {
            for (int i = 0; i < sizes[s]; i++) {
                x[i] = i;
                y[i] = 0.5 * i + (double)sb_random_below(&random, 1 << 20) / (1 << 20);
            }
            const struct sb_line line = sb_theil_sen(x, y, sizes[s], 0.95, scratch);
            covered += line.slope.lo <= 0.5 && 0.5 <= line.slope.hi;
        }
        assert_in_range(covered, 930, 1000);
    }
}

static void what_has_no_slope_has_no_line(void **state)
{
    (void)state;
    const double same[] = {2, 2, 2};
    assert_true(isnan(sb_theil_sen(same, same, 3, 0.95, scratch).slope.point));
    assert_true(isnan(sb_theil_sen(same, same, 1, 0.95, scratch).slope.point));
    assert_true(isnan(sb_theil_sen(same, same, 0, 0.95, scratch).intercept));
}

// --- two segments -------------------------------------------------------------------------

static double deviation_of(const struct sb_bend *bend, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fabs(y[i] - bend->level - bend->slope * fmax(x[i] - bend->at, 0));
    return sum;
}

static void a_bend_is_found_at_a_point_and_between_two(void **state)
{
    (void)state;
    static const double places[] = {1, 2, 3, 4, 6, 8, 12, 16};
    static const double breaks[] = {3, 4, 4.75, 7};
    for (int b = 0; b < 4; b++) {
        struct sb_bend bend;
        for (int i = 0; i < 8; i++) {
            x[i] = places[i];
            y[i] = 2 + 0.3 * fmax(x[i] - breaks[b], 0);
        }
        assert_true(sb_bend_fit(x, y, 8, scratch, &bend));
        check_close(bend.at, breaks[b], 1e-9);
        check_close(bend.level, 2, 1e-12);
        check_close(bend.slope, 0.3, 1e-12);
        check_close(bend.deviation, 0, 1e-12);
        assert_true(sb_bend_is_clear(&bend, x, y, 8, scratch));
    }
}

// No bend of a fine grid over all three parameters leaves less.
static void no_bend_of_a_grid_leaves_less_deviation(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(23);
    for (int trial = 0; trial < 20; trial++) {
        struct sb_bend bend;
        for (int i = 0; i < 7; i++) {
            x[i] = i + 1;
            y[i] = (double)sb_random_below(&random, 1000) / 100;
        }
        assert_true(sb_bend_fit(x, y, 7, scratch, &bend));
        check_close(bend.deviation, deviation_of(&bend, 7), 1e-9);
        for (int at = 0; at <= 40; at++)
            for (int level = 0; level <= 40; level++)
                for (int slope = -40; slope <= 40; slope++) {
                    const struct sb_bend other = {.at = 2 + 0.1 * at,
                                                  .level = 0.25 * level,
                                                  .slope = 0.125 * slope};
                    assert_true(deviation_of(&other, 7) >= bend.deviation - 1e-9);
                }
    }
}

static void noisy_lines_rarely_bend_and_noisy_bends_nearly_always_do(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(7);
    int bent_lines = 0, bent_bends = 0;
    for (int trial = 0; trial < 500; trial++)
        for (int bent = 0; bent < 2; bent++) {
            struct sb_bend bend;
            for (int i = 0; i < 8; i++) {
                x[i] = i + 1;
                const double noise = (double)sb_random_below(&random, 1000) / 1000 - 0.5;
                y[i] = 2 + 0.3 * (bent ? fmax(x[i] - 4.5, 0) : x[i]) + 0.04 * noise;
            }
            assert_true(sb_bend_fit(x, y, 8, scratch, &bend));
            *(bent ? &bent_bends : &bent_lines) +=
                sb_bend_is_clear(&bend, x, y, 8, scratch);
        }
    assert_in_range(bent_lines, 0, 10);
    assert_in_range(bent_bends, 475, 500);
}

static void five_points_a_fall_and_a_first_part_that_rises_are_no_bend(void **state)
{
    (void)state;
    struct sb_bend bend;
    for (int i = 0; i < 8; i++) {
        x[i] = i;
        y[i] = 2 + 0.3 * fmax(x[i] - 3, 0);
    }
    assert_true(sb_bend_fit(x, y, 5, scratch, &bend));
    assert_false(sb_bend_is_clear(&bend, x, y, 5, scratch));
    assert_false(sb_bend_fit(x, y, 3, scratch, &bend));
    for (int i = 0; i < 8; i++)
        y[i] = 2 - 0.3 * fmax(x[i] - 3, 0);
    assert_true(sb_bend_fit(x, y, 8, scratch, &bend));
    assert_false(sb_bend_is_clear(&bend, x, y, 8, scratch));
    // A slope of 1 that becomes one of 3 is two segments, but none of them is free.
    for (int i = 0; i < 8; i++)
        y[i] = 2 + x[i] + 2 * fmax(x[i] - 3, 0);
    assert_true(sb_bend_fit(x, y, 8, scratch, &bend));
    assert_false(sb_bend_is_clear(&bend, x, y, 8, scratch));
    for (int i = 0; i < 8; i++)
        y[i] = 2 + 0.1 * x[i]; // straight but for rounding
    assert_true(sb_bend_fit(x, y, 8, scratch, &bend));
    assert_false(sb_bend_is_clear(&bend, x, y, 8, scratch));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slope_and_interval_are_the_listed_slopes_at_the_enumerated_rank),
        cmocka_unit_test(ranks_are_those_of_kendalls_table),
        cmocka_unit_test(the_line_is_exact_and_bears_a_quarter_of_wild_points),
        cmocka_unit_test(
            the_interval_covers_and_does_not_jump_where_the_approximation_begins),
        cmocka_unit_test(what_has_no_slope_has_no_line),
        cmocka_unit_test(a_bend_is_found_at_a_point_and_between_two),
        cmocka_unit_test(no_bend_of_a_grid_leaves_less_deviation),
        cmocka_unit_test(noisy_lines_rarely_bend_and_noisy_bends_nearly_always_do),
        cmocka_unit_test(five_points_a_fall_and_a_first_part_that_rises_are_no_bend),
    };
    return run_tests(tests);
}
