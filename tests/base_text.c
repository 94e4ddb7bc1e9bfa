#include "test.h"

#include "base/error.h"
#include "base/text.h"
#include "base/words.h"

static void numbers_print_as_short_as_they_read_back(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},        {4, "4"},
                 {30, "30"},      {100000, "100000"},
                 {0.1, "0.1"},    {-2.5, "-2.5"},
                 {1e12, "1e+12"}, {1.0 / 3, "0.3333333333333333"},
                 {1e-7, "1e-07"}, {123456.5, "123456.5"}};
    char buffer[32];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(sb_number_text(cases[i].value, buffer), cases[i].text);
    uint64_t bits = 0x9E3779B97F4A7C15u;
    for (int i = 0; i < 20000; i++) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value))
            assert_true(strtod(sb_number_text(value, buffer), NULL) == value);
    }
}

static void only_whole_finite_numbers_parse(void **state)
{
    (void)state;
    double value = 7;
    assert_true(sb_parse_number("-1.5e3", &value));
    check_close(value, -1500, 0);
    static const char *const bad[] = {"",   "4x",   "nan", "inf", "1e999",
                                      " 4", "0x10", "1,5", "-"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(sb_parse_number(bad[i], &value));
}

static void the_nearest_word_is_found_and_far_ones_are_not(void **state)
{
    (void)state;
    static const char *const words[] = {"vertex", "fragment", "point"};
    assert_string_equal(sb_nearest_word("vretex", words, 3), "vertex");
    assert_string_equal(sb_nearest_word("fragmant", words, 3), "fragment");
    assert_null(sb_nearest_word("shadow", words, 3));
}

static void text_grows_and_keeps_its_end(void **state)
{
    (void)state;
    struct sb_text text = {0};
    assert_string_equal(sb_text_get(&text), "");
    for (int i = 0; i < 1000; i++)
        sb_text_printf(&text, "%d,", i);
    assert_int_equal(text.length, strlen(text.data));
    assert_string_equal(text.data + text.length - 4, "999,");
    sb_text_clear(&text);
    assert_string_equal(sb_text_get(&text), "");
    sb_text_free(&text);
}

static void width_counts_characters_not_bytes(void **state)
{
    (void)state;
    assert_int_equal(sb_text_width("± 3"), 3);
}

static void an_error_may_quote_itself(void **state)
{
    (void)state;
    struct sb_error err = {0};
    assert_false(sb_fail(&err, SB_BAD_INPUT, "%s is wrong", "this"));
    sb_fail(&err, err.status, "suite.yaml:3:4: %s", err.text);
    assert_string_equal(err.text, "suite.yaml:3:4: this is wrong");
    assert_int_equal(err.status, SB_BAD_INPUT);
}

static void every_status_is_found_by_its_word_and_has_a_known_exit_code(void **state)
{
    (void)state;
    for (int i = 0; i < SB_STATUS_COUNT; i++) {
        assert_int_equal(sb_status_find(sb_status_rows[i].word), i);
        const int code = sb_status_rows[i].exit_code;
        assert_true(code == 0 || code == 1 || code == 2 || code == 3 || code == 4 ||
                    code == 77 || code == 130);
        assert_true(strlen(sb_status_rows[i].help) > 0);
    }
    assert_int_equal(sb_status_find("nonsense"), SB_STATUS_COUNT);
}

static void the_worse_exit_code_wins_either_way_round(void **state)
{
    (void)state;
    assert_int_equal(sb_exit_code_worse(0, 3), 3);
    assert_int_equal(sb_exit_code_worse(3, 2), 2);
    assert_int_equal(sb_exit_code_worse(130, 3), 3);
    assert_int_equal(sb_exit_code_worse(0, 130), 130);
    assert_int_equal(sb_exit_code_worse(0, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_print_as_short_as_they_read_back),
        cmocka_unit_test(only_whole_finite_numbers_parse),
        cmocka_unit_test(the_nearest_word_is_found_and_far_ones_are_not),
        cmocka_unit_test(text_grows_and_keeps_its_end),
        cmocka_unit_test(width_counts_characters_not_bytes),
        cmocka_unit_test(an_error_may_quote_itself),
        cmocka_unit_test(every_status_is_found_by_its_word_and_has_a_known_exit_code),
        cmocka_unit_test(the_worse_exit_code_wins_either_way_round),
    };
    return run_tests(tests);
}
