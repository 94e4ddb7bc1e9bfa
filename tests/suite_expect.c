// `expect:` of a suite: what is kept of it, and where the words stood.
#include "test.h"

#include "suite_text.h"

static const char head[] = "suite: x\nsweep: {point: [1, 8]}\nexpect:\n";

static void must_expect(const char *items)
{
    char text[1024];
    snprintf(text, sizeof text, "%s%s", head, items);
    must_load(text);
}

#define must_refuse(items, place, part)                                                  \
    do {                                                                                 \
        char text[1024];                                                                 \
        snprintf(text, sizeof text, "%s%s", head, items);                                \
        must_fail(text, place, part);                                                    \
    } while (0)

static void check_place(const char *at, const char *place)
{
    char wanted[160];
    snprintf(wanted, sizeof wanted, "%s:%s", file, place);
    assert_string_equal(at, wanted);
}

static void every_column_of_an_item_is_one_expectation(void **state)
{
    (void)state;
    must_expect("  - where: {point: 8}\n    max_err: \"<= 2/255\"\n    nonfinite: 0\n"
                "  - {status: ok}\n");
    assert_int_equal(suite.expect_count, 3);
    const struct sb_expectation *e = suite.expect;
    assert_string_equal(e[0].column, "max_err");
    assert_string_equal(e[0].bound, "<= 2/255");
    check_place(e[0].column_at, "5:5");
    check_place(e[0].bound_at, "5:14");
    assert_string_equal(e[1].column, "nonfinite");
    assert_string_equal(e[1].bound, "0");
    check_place(e[1].bound_at, "6:16");
    assert_int_equal(e[1].axis_count, 1);
    assert_int_equal(e[1].axis[0].axis, SB_AXIS_POINT);
    check_close(e[1].axis[0].value[0], 8, 0);
    assert_string_equal(e[2].column, "status");
    assert_int_equal(e[2].axis_count, 0);
    assert_int_equal(e[2].scene_count, 0);
}

static void conditions_are_values_ranges_words_and_scenes(void **state)
{
    (void)state;
    must_expect(
        "  - max_err: 1\n"
        "    where: {scene: [room, sphere], point: [0, 2..8 x2], stage: vertex}\n");
    assert_int_equal(suite.expect_count, 1);
    const struct sb_expectation *e = suite.expect;
    assert_int_equal(e->scene_count, 2);
    assert_string_equal(e->scene[1], "sphere");
    assert_int_equal(e->axis_count, 2);
    assert_int_equal(e->axis[0].count, 4);
    check_close(e->axis[0].value[3], 8, 0);
    assert_int_equal(e->axis[1].axis, SB_AXIS_STAGE);
    check_close(e->axis[1].value[0], SB_STAGE_VERTEX, 0);
    must_expect("  - {max_err: 1, where: {}}\n");
    assert_int_equal(suite.expect->axis_count, 0);
}

static void axes_that_the_suite_declares_are_known(void **state)
{
    (void)state;
    must_load(
        "suite: x\n"
        "expect: [{where: {taps: 3}, max_err: 1}]\n"
        "axes: [{name: taps, kind: quality, define: TAPS, min: 0, max: 9, init: 0}]\n");
    assert_int_equal(suite.expect->axis[0].axis, SB_AXIS_BUILTIN_COUNT);
}

static void what_is_wrong_is_said_where_it_stands(void **state)
{
    (void)state;
    must_refuse("  - {where: {pont: 8}, max_err: 1}\n", ":4:14",
                "unknown axis \"pont\"; did you mean \"point\"?");
    must_refuse("  - {where: {point: eight}, max_err: 1}\n", ":4:21",
                "\"eight\" is not a number");
    must_refuse("  - {where: {stage: [vertex, pixel]}, max_err: 1}\n", ":4:30",
                "unknown value \"pixel\"");
    must_refuse("  - {where: {point: []}, max_err: 1}\n", ":4:14", "point: no values");
    must_refuse("  - {where: {scene: []}, max_err: 1}\n", ":4:21",
                "scene: an empty list");
    must_refuse("  - {where: {scene: {a: b}}, max_err: 1}\n", ":4:21",
                "must be one word");
    must_refuse("  - {where: point=8, max_err: 1}\n", ":4:13", "where must be a map");
    must_refuse("  - {where: {point: 8}}\n", ":4:5", "nothing is expected here");
    must_refuse("  - {}\n", ":4:5", "nothing is expected here");
    must_refuse("  - {max_err: [1, 2]}\n", ":4:15", "max_err must be one word");
    must_refuse("  - max_err\n", ":4:5", "an item of expect must be a map");
    must_fail("suite: x\nexpect: []\n", ":2:9", "expect: an empty list");
    must_fail("suite: x\nexpect: {max_err: 1}\n", ":2:9", "expect must be a list");
    must_fail("suite: x\nexpects: []\n", ":2:1", "did you mean \"expect\"?");
    must_fail("suite: x\nparts: [{expect: []}]\n", ":2:10", "unknown key \"expect\"");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_suite)
    const struct CMUnitTest tests[] = {
        TEST(every_column_of_an_item_is_one_expectation),
        TEST(conditions_are_values_ranges_words_and_scenes),
        TEST(axes_that_the_suite_declares_are_known),
        TEST(what_is_wrong_is_said_where_it_stands),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
