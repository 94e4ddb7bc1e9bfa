#include "test.h"

#include "suite/suite.h"

static void every_default_is_valid_and_every_row_has_help(void **state)
{
    (void)state;
    for (int i = 0; i < sb_measure_row_count; i++) {
        const struct sb_measure_row *row = &sb_measure_rows[i];
        struct sb_measure_settings settings;
        struct sb_error err;
        char text[32];
        memset(&settings, 0xff, sizeof settings);
        if (!sb_measure_set(&settings, row->name, sb_number_text(row->init, text), &err))
            fail_msg("%s", err.text);
        assert_true(strlen(row->help) > 0);
    }
}

static void each_name_sets_its_own_field(void **state)
{
    (void)state;
    struct sb_measure_settings settings;
    struct sb_error err;
    sb_measure_defaults(&settings);
    check_close(settings.half_width, 0.01, 0);
    check_close(settings.first_look, 60, 0);
    check_close(settings.rounds, 2000, 0);
    check_close(settings.seed, 1, 0);
    assert_true(sb_measure_set(&settings, "half_width", "0.5", &err));
    assert_true(sb_measure_set(&settings, "seed", "9007199254740991", &err));
    check_close(settings.half_width, 0.5, 0);
    check_close(settings.seed, 9007199254740991.0, 0);
    check_close(settings.first_look, 60, 0);
    check_close(settings.batch, 0, 0);
}

static void wrong_settings_are_refused_with_the_valid_ones(void **state)
{
    (void)state;
    struct sb_measure_settings settings;
    struct sb_error err;
    sb_measure_defaults(&settings);
    assert_false(sb_measure_set(&settings, "sed", "1", &err));
    check_contains(err.text, "unknown setting \"sed\"; did you mean \"seed\"? valid: ");
    for (int i = 0; i < sb_measure_row_count; i++)
        check_contains(err.text, sb_measure_rows[i].name);
    assert_false(sb_measure_set(&settings, "rounds", "0", &err));
    check_contains(err.text, "rounds: 0 is out of range; valid: whole numbers from 1 to");
    assert_false(sb_measure_set(&settings, "rounds", "1.5", &err));
    check_contains(err.text, "1.5 is not a whole number");
    assert_false(sb_measure_set(&settings, "budget", "soon", &err));
    check_contains(err.text, "\"soon\" is not a number; valid: numbers from 0.01 to");
    check_close(settings.rounds, 2000, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_default_is_valid_and_every_row_has_help),
        cmocka_unit_test(each_name_sets_its_own_field),
        cmocka_unit_test(wrong_settings_are_refused_with_the_valid_ones),
    };
    return run_tests(tests);
}
