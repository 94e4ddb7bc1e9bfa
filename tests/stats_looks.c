#include "test.h"

#include "stats/looks.h"

static void looks_double_and_end_with_the_last_round(void **state)
{
    (void)state;
    const struct sb_looks looks = {.first = 60, .rounds = 2000};
    const int expected[] = {60, 120, 240, 480, 960, 1920, 2000};
    int found = 0;
    for (int rounds = 0; rounds <= 2000; rounds++)
        if (sb_look_due(&looks, rounds))
            assert_int_equal(rounds, expected[found++]);
    assert_int_equal(found, 7);
    assert_int_equal(sb_look_count(&looks), 7);
}

static void count_is_the_number_of_looks_that_fall_due(void **state)
{
    (void)state;
    for (int first = 1; first <= 70; first++)
        for (int last = 1; last <= 300; last++) {
            const struct sb_looks looks = {.first = first, .rounds = last};
            int due = 0;
            for (int rounds = 0; rounds <= last; rounds++)
                due += sb_look_due(&looks, rounds);
            assert_int_equal(due, sb_look_count(&looks));
        }
}

static void level_shares_five_percent_between_the_looks(void **state)
{
    (void)state;
    const struct sb_looks one = {.first = 60, .rounds = 60}, two = {60, 61},
                          five = {15, 240};
    check_close(sb_look_level(&one), .95, 1e-15);
    check_close(sb_look_level(&two), .975, 1e-15);
    check_close(sb_look_level(&five), .99, 1e-15);
}

static void huge_schedules_do_not_overflow(void **state)
{
    (void)state;
    const struct sb_looks looks = {.first = 2000000000, .rounds = 2147483647};
    assert_int_equal(sb_look_count(&looks), 2);
    assert_true(sb_look_due(&looks, 2147483647));
    assert_false(sb_look_due(&looks, 2147483646));
}

static void precise_enough_compares_the_half_width_with_the_point(void **state)
{
    (void)state;
    const struct sb_interval narrow = {200, 198, 202, 60}, wide = {200, 198, 202.5, 60};
    const struct sb_interval lopsided = {200, 200, 204, 60}, unknown = {200, NAN, NAN, 3};
    assert_true(sb_precise_enough(&narrow, .01));
    assert_false(sb_precise_enough(&wide, .01));
    assert_true(sb_precise_enough(&lopsided, .01));
    assert_false(sb_precise_enough(&unknown, .01));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looks_double_and_end_with_the_last_round),
        cmocka_unit_test(count_is_the_number_of_looks_that_fall_due),
        cmocka_unit_test(level_shares_five_percent_between_the_looks),
        cmocka_unit_test(huge_schedules_do_not_overflow),
        cmocka_unit_test(precise_enough_compares_the_half_width_with_the_point),
    };
    return run_tests(tests);
}
