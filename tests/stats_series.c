#include "test.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_series_does_not_drift),
        cmocka_unit_test(a_step_in_the_middle_is_the_drift),
        cmocka_unit_test(spikes_are_no_drift),
        cmocka_unit_test(quarters_of_uneven_series_share_no_sample),
    };
    return run_tests(tests);
}
