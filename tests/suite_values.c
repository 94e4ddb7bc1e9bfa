// Ranges and lists against values written out.
#include "test.h"

#include "suite/values.h"

static struct sb_values values;
static struct sb_error err;

static bool read_text(int axis, const char *text)
{
    values.count = 0;
    return sb_values_add(sb_axes_builtin(), axis, text, &values, &err);
}

#define gives(axis, text, ...)                                                           \
    gives_at(axis, text, (const double[]){__VA_ARGS__},                                  \
             (int)(sizeof((const double[]){__VA_ARGS__}) / sizeof(double)), __FILE__,    \
             __LINE__)
static void gives_at(int axis, const char *text, const double *expected, int count,
                     const char *file, int line)
{
    if (!read_text(axis, text)) {
        print_error("%s\n", err.text);
        _fail(file, line);
    }
    bool same = values.count == count;
    for (int i = 0; same && i < count; i++)
        same = values.value[i] == expected[i]; // exactly: equal to what a list would give
    if (same)
        return;
    print_error("\"%s\" gives %d values:", text, values.count);
    for (int i = 0; i < values.count; i++)
        print_error(" %.17g", values.value[i]);
    print_error("\n");
    _fail(file, line);
}

static void refused(int axis, const char *text, const char *part)
{
    if (read_text(axis, text))
        fail_msg("\"%s\" was accepted", text);
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, part);
}

static void a_range_counts_up_to_its_end(void **state)
{
    (void)state;
    gives(SB_AXIS_POINT, "0..4", 0, 1, 2, 3, 4);
    gives(SB_AXIS_POINT, "0..32 step 8", 0, 8, 16, 24, 32);
    gives(SB_AXIS_POINT, "0..31 step 8", 0, 8, 16, 24);
    gives(SB_AXIS_POINT, "5..5", 5);
    gives(SB_AXIS_THREADS, "-1..2", -1, 0, 1, 2);
}

static void a_range_multiplies_up_to_its_end(void **state)
{
    (void)state;
    gives(SB_AXIS_POINT, "1..64 x2", 1, 2, 4, 8, 16, 32, 64);
    gives(SB_AXIS_POINT, "3..100 x3", 3, 9, 27, 81);
    gives(SB_AXIS_TESSELLATION, "200..200000 x10", 200, 2000, 20000, 200000);
    gives(SB_AXIS_SCALE, "0.001..10 x10", 0.001, 0.01, 0.1, 1, 10);
}

static void decimal_steps_give_the_numbers_that_a_list_would(void **state)
{
    (void)state;
    gives(SB_AXIS_OFFSET, "0..1 step 0.1", 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9,
          1);
    gives(SB_AXIS_OFFSET, "0..0.3 step 0.1", 0, 0.1, 0.2, 0.3);
    gives(SB_AXIS_OFFSET, "1e11..1e12 step 3e11", 1e11, 4e11, 7e11, 1e12);
    // Three steps are 2e-14 past the end: the end is meant, and not passed.
    gives(SB_AXIS_OFFSET, "0..1 step 0.33333333333334", 0, 0.33333333333334,
          0.66666666666668, 1);
}

// Steps that cross 0 are the hard ones: -90 + 82 * 1.1 in doubles is 0.20000000000001705.
static void fractional_steps_add_up_no_error(void **state)
{
    (void)state;
    gives(SB_AXIS_SUN, "-1..1 step 0.25", -1, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 1);
    assert_true(read_text(SB_AXIS_SUN, "-90..360 step 1.1"));
    assert_int_equal(values.count, 410); // 450 / 1.1 = 409.09
    for (int i = 0; i < values.count; i++) {
        const int tenths = -900 + 11 * i;
        char decimal[32]; // what a list would hold, and strtod reads it to the last bit
        snprintf(decimal, sizeof decimal, "%s%d.%d", tenths < 0 ? "-" : "",
                 abs(tenths) / 10, abs(tenths) % 10);
        if (values.value[i] != strtod(decimal, NULL))
            fail_msg("value %d is %.17g, not %s", i, values.value[i], decimal);
    }
    gives(SB_AXIS_SUN, "-0.3..0.3 step 0.1", -0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3);
}

static void words_numbers_and_ranges_mix_with_commas(void **state)
{
    (void)state;
    gives(SB_AXIS_POINT, "0, 1..8 x2 ,32", 0, 1, 2, 4, 8, 32);
    gives(SB_AXIS_STAGE, "vertex,fragment", SB_STAGE_VERTEX, SB_STAGE_FRAGMENT);
    gives(SB_AXIS_MAPS, "none, diffuse+specular", SB_MAPS_NONE, SB_MAPS_DS);
}

static void blanks_around_the_parts_do_not_matter(void **state)
{
    (void)state;
    gives(SB_AXIS_POINT, " 0 .. 8  step  4 ", 0, 4, 8);
    gives(SB_AXIS_POINT, "1..4 x 2", 1, 2, 4);
}

static void ranges_that_never_end_or_never_start_are_refused(void **state)
{
    (void)state;
    refused(SB_AXIS_POINT, "0..8 step 0",
            "range \"0..8 step 0\" must have a step above 0");
    refused(SB_AXIS_POINT, "0..8 step -1", "step above 0");
    refused(SB_AXIS_POINT, "1..8 x1", "must have a factor above 1");
    refused(SB_AXIS_POINT, "1..8 x0.5", "factor above 1");
    refused(SB_AXIS_POINT, "0..8 x2", "must start above 0");
    refused(SB_AXIS_POINT, "8..0", "must go up");
}

static void malformed_ranges_are_refused_with_the_valid_forms(void **state)
{
    (void)state;
    static const char *const bad[] = {"0..8 by 2", "0..8 step",   "1..8 x",
                                      "0..8 2",    "0..8 step x", "0..8 steps 2"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        refused(SB_AXIS_POINT, bad[i], "is not of the form A..B, A..B step S or A..B xF");
    refused(SB_AXIS_POINT, "..8", "\"\" is not a number");
    refused(SB_AXIS_POINT, "0..", "\"\" is not a number");
    refused(SB_AXIS_POINT, "0..b", "\"b\" is not a number");
    refused(SB_AXIS_POINT, "0..300",
            "300 is out of range; valid: whole numbers from 0 to 256");
    refused(SB_AXIS_POINT, "1,,2", "\"\" is not a number");
    refused(SB_AXIS_STAGE, "fragment..vertex", "unknown value \"fragment..vertex\"");
}

static void whole_axes_refuse_fractions(void **state)
{
    (void)state;
    refused(SB_AXIS_POINT, "0..1 step 0.5", "0.5 is not a whole number");
    refused(SB_AXIS_POINT, "1..4 x1.5", "1.5 is not a whole number");
    refused(SB_AXIS_POINT, "0.5..4", "0.5 is not a whole number");
}

static void more_than_4096_values_are_refused(void **state)
{
    (void)state;
    assert_true(read_text(SB_AXIS_WIDTH, "1..4096"));
    assert_int_equal(values.count, 4096);
    refused(SB_AXIS_WIDTH, "1..4097", "more than 4096 values");
    refused(SB_AXIS_WIDTH, "1..4000,1..97", "more than 4096 values");
    refused(SB_AXIS_OFFSET, "0..1 step 1e-300", "more than 4096 values");
    refused(SB_AXIS_OFFSET, "1e11..1e12 step 1e-9", "more than 4096 values");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_range_counts_up_to_its_end),
        cmocka_unit_test(a_range_multiplies_up_to_its_end),
        cmocka_unit_test(decimal_steps_give_the_numbers_that_a_list_would),
        cmocka_unit_test(fractional_steps_add_up_no_error),
        cmocka_unit_test(words_numbers_and_ranges_mix_with_commas),
        cmocka_unit_test(blanks_around_the_parts_do_not_matter),
        cmocka_unit_test(ranges_that_never_end_or_never_start_are_refused),
        cmocka_unit_test(malformed_ranges_are_refused_with_the_valid_forms),
        cmocka_unit_test(whole_axes_refuse_fractions),
        cmocka_unit_test(more_than_4096_values_are_refused),
    };
    return run_tests(tests);
}
