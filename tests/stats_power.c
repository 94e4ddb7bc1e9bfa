#include "test.h"

#include <limits.h>

#include "noise.h"
#include "stats/power.h"
#include "stats/signed_rank.h"

enum { MOST = 400 };
static double d[MOST], scratch[MOST];

static void spread_is_the_deviation_of_normal_values_and_bears_spikes(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    double sum = 0;
    for (int trial = 0; trial < 200; trial++) {
        for (int i = 0; i < MOST; i++)
            d[i] = i % 20 == 7 ? 1e9 : 5 + 0.04 * normal_noise(&random);
        sum += sb_robust_spread(d, MOST, scratch) / 200;
    }
    check_close(sum, 0.04, 0.004); // a twentieth of spikes widens it a little
    const double few[] = {1, 2, 4, 8, 100};
    check_close(sb_robust_spread(few, 5, scratch), 1.4826 * 3, 1e-15);
    const double same[] = {3, 3, 3, 9};
    check_close(sb_robust_spread(same, 4, scratch), 0, 0);
    assert_true(isnan(sb_robust_spread(same, 0, scratch)));
}

// z of printed tables: 1.95996 at 97.5 %, 3.29053 at 99.95 %, 1.28155 at 90 %.
static void pairs_and_effects_are_those_computed_by_hand(void **state)
{
    (void)state;
    assert_int_equal(sb_pairs_for_interval(.04, .01, .95), 64);
    assert_int_equal(sb_pairs_for_interval(.03, .01, .95), 36);
    check_close(sb_detectable_effect(.04, 240, .0005, .9),
                (3.29053 + 1.28155) * 1.02 * .04 / sqrt(240), 1e-7);
    assert_int_equal(sb_pairs_to_detect(.04, .01, .0005, .9),
                     ceil(pow((3.29053 + 1.28155) * 1.02 * 4, 2)));
    assert_int_equal(sb_pairs_to_detect(.04, 0, .0005, .9), INT_MAX);
    assert_int_equal(sb_pairs_to_detect(.04, 1e-9, .0005, .9), INT_MAX);
    assert_int_equal(sb_pairs_to_detect(0, .01, .0005, .9), 1);
    assert_int_equal(sb_pairs_for_interval(.04, 0, .95), INT_MAX);
}

static void pairs_and_detectable_effect_answer_each_other(void **state)
{
    (void)state;
    for (int n = 1; n <= 500; n++) {
        const double effect = sb_detectable_effect(.03, n, .01, .8);
        assert_int_equal(sb_pairs_to_detect(.03, effect, .01, .8), n);
    }
}

// What is promised is what the test does: found in nine of ten series.
static void the_detectable_effect_is_found_with_the_power_asked_for(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(23);
    enum { TRIALS = 2000, N = 240 };
    const double effect = sb_detectable_effect(.04, N, .0005, .9);
    int found = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        for (int i = 0; i < N; i++)
            d[i] = .02 + effect + .04 * normal_noise(&random);
        found += sb_signed_rank_p(d, N, .02, SB_GREATER, scratch) < .0005;
    }
    check_close((double)found / TRIALS, .9, .03);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spread_is_the_deviation_of_normal_values_and_bears_spikes),
        cmocka_unit_test(pairs_and_effects_are_those_computed_by_hand),
        cmocka_unit_test(pairs_and_detectable_effect_answer_each_other),
        cmocka_unit_test(the_detectable_effect_is_found_with_the_power_asked_for),
    };
    return run_tests(tests);
}
