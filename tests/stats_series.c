#include "test.h"

#include "math/random.h"
#include "stats/series.h"

static void a_level_series_does_not_drift(void **state)
{
    (void)state;
    double values[80], scratch[80];
    for (int i = 0; i < 80; i++)
        values[i] = 10 + i % 4;
    check_close(sb_drift(values, 80, scratch), 0, 0);
}

static void a_step_in_the_middle_is_the_drift(void **state)
{
    (void)state;
    double values[40], scratch[40];
    for (int i = 0; i < 40; i++)
        values[i] = i < 20 ? 9 : 11;
    check_close(sb_drift(values, 40, scratch), 0.2, 1e-15); // 2 over a median of 10
}

static void spikes_are_no_drift(void **state)
{
    (void)state;
    double values[40], scratch[40];
    for (int i = 0; i < 40; i++)
        values[i] = i % 10 == 3 ? 1000 : 5;
    check_close(sb_drift(values, 40, scratch), 0, 0);
}

static void quarters_of_uneven_series_share_no_sample(void **state)
{
    (void)state;
    // 0 | 1 | 2 | 3 4: the last quarter has two.
    const double values[] = {10, 11, 12, 13, 14};
    double scratch[5];
    check_close(sb_drift(values, 5, scratch), 3.5 / 12, 1e-15);
    assert_true(isnan(sb_drift(values, 3, scratch)));
}

// Distinct values: Spearman's rho of a series and itself one later, up to the ends.
static void rank_autocorrelation_is_that_of_the_ranks_whatever_the_values(void **state)
{
    (void)state;
    const double rising[] = {1, 2, 3, 4, 1e9}, zigzag[] = {1, 9, 2, 8, 3};
    const double tied[] = {7, 7, 1, 1};
    double scratch[10];
    // Ranks less their mean: -2 -1 0 1 2, then -2 2 -1 1 0, then 1 1 -1 -1.
    check_close(sb_rank_autocorrelation(rising, 5, scratch), 4 / 10.0, 1e-15);
    check_close(sb_rank_autocorrelation(zigzag, 5, scratch), -7 / 10.0, 1e-15);
    check_close(sb_rank_autocorrelation(tied, 4, scratch), 1 / 4.0, 1e-15);
    assert_true(isnan(sb_rank_autocorrelation(tied, 2, scratch)));
    assert_true(isnan(sb_rank_autocorrelation(tied, 0, scratch)));
}

static void rank_autocorrelation_finds_that_of_a_series_with_spikes(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    enum { N = 4000 };
    static double values[N], scratch[2 * N];
    for (int memory = 0; memory < 4; memory++) {
        const double rho = 0.2 * memory;
        double at = 0;
        for (int i = 0; i < N; i++) {
            double noise = -6; // of twelve uniform ones: nearly normal
            for (int k = 0; k < 12; k++)
                noise += sb_random_unit(&random);
            at = rho * at + sqrt(1 - rho * rho) * noise;
            values[i] = i % 100 == 99 ? 1e9 : at;
        }
        check_close(sb_rank_autocorrelation(values, N, scratch), rho, 0.06);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_series_does_not_drift),
        cmocka_unit_test(a_step_in_the_middle_is_the_drift),
        cmocka_unit_test(spikes_are_no_drift),
        cmocka_unit_test(quarters_of_uneven_series_share_no_sample),
        cmocka_unit_test(rank_autocorrelation_is_that_of_the_ranks_whatever_the_values),
        cmocka_unit_test(rank_autocorrelation_finds_that_of_a_series_with_spikes),
    };
    return run_tests(tests);
}
