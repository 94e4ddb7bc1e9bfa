// Axes that a suite declares are axes like any other.
#include "test.h"

#include "suite_text.h"

#define HEAD "suite: x\naxes:\n"
static const char two_axes[] =
    HEAD "  - name: curve\n"
         "    kind: quality\n"
         "    define: CURVE\n"
         "    help: which curve\n"
         "    values: [linear, {name: cubic, text: cubic_fast, help: smoother}, cosine]\n"
         "    init: cosine\n"
         "  - {name: taps, kind: quality, define: NR_TAPS, min: 1, max: 16, init: 4,\n"
         "     whole: true, when: curve!=linear, needs: stage=fragment}\n";

static void load_more(const char *rest)
{
    char text[2048];
    snprintf(text, sizeof text, "%s%s", two_axes, rest);
    must_load(text);
}

static void own_axes_become_rows_behind_the_builtin_ones(void **state)
{
    (void)state;
    load_more("");
    assert_int_equal(suite.axes.count, SB_AXIS_BUILTIN_COUNT + 2);
    const struct sb_axis *curve = &suite.axes.row[SB_AXIS_BUILTIN_COUNT];
    assert_string_equal(curve->name, "curve");
    assert_string_equal(curve->define, "CURVE");
    assert_string_equal(curve->help, "which curve");
    assert_int_equal(curve->kind, SB_QUALITY);
    assert_int_equal(curve->value_count, 3);
    assert_string_equal(curve->values[0].text, "linear");
    assert_string_equal(curve->values[1].text, "cubic_fast");
    assert_string_equal(curve->values[1].help, "smoother");
    check_close(curve->init, 2, 0);
    check_close(curve->max, 2, 0);
    const struct sb_axis *taps = &suite.axes.row[SB_AXIS_BUILTIN_COUNT + 1];
    assert_null(taps->values);
    check_close(taps->min, 1, 0);
    check_close(taps->max, 16, 0);
    check_close(taps->init, 4, 0);
    assert_int_equal(taps->flags, SB_WHOLE);
}

static void own_axes_work_in_base_sweep_cross_and_exclude(void **state)
{
    (void)state;
    load_more("base: {curve: cubic}\nsweep: {taps: 1..4 x2}\ncross: {point: [1, 2]}\n"
              "exclude: taps=2,point=2\n");
    must_be("point=1,curve=cubic,taps=1", "point=2,curve=cubic,taps=1",
            "point=1,curve=cubic,taps=2", "point=1,curve=cubic,taps=4",
            "point=2,curve=cubic,taps=4");
    load_more(
        "sweep: {curve: [linear, cubic]}\ncross: {taps: [2, 3]}\n"); // moot at linear
    must_be("curve=linear", "curve=cubic,taps=2", "curve=cubic,taps=3");
    assert_int_equal(suite.duplicates, 1);
}

static void exclude_keeps_out_what_an_axis_needs_and_has_not(void **state)
{
    (void)state;
    char text[2048];
    snprintf(text, sizeof text, "%scross: {stage: [fragment, vertex], taps: [4, 8]}\n",
             two_axes);
    must_fail(text, "", "variant stage=vertex,taps=8: taps=8 needs stage=fragment");
    load_more("cross: {stage: [fragment, vertex], taps: [4, 8]}\n"
              "exclude: stage=vertex,taps>4\n");
    must_be("stage=fragment,taps=4", "stage=fragment,taps=8", "stage=vertex,taps=4");
}

static void wrong_axes_are_refused_where_they_stand(void **state)
{
    (void)state;
    must_fail(HEAD "  - {kind: quality, define: A}\n", ":3:5", "an axis needs a name");
    must_fail(HEAD "  - {name: a, define: A}\n", ":3:5", "an axis needs a kind");
    must_fail(HEAD "  - {name: a, kind: quality}\n", ":3:5", "an axis needs a define");
    must_fail(
        HEAD "  - {name: a, kind: qualty, define: A}\n", ":3:21",
        "a: unknown kind \"qualty\"; did you mean \"quality\"? valid: platform scene");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, colour: red}\n", ":3:41",
              "unknown key \"colour\"; valid: name kind");
    must_fail(HEAD "  - {name: a, kind: quality, define: A}\n", ":3:5",
              "axis \"a\" has no min");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, min: 1, max: 2}\n", ":3:5",
              "has no init");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, min: 1, max: 2, init: b}\n",
              ":3:63", "init: \"b\" is not a number");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, min: 1, max: 2, init: 3}\n",
              ":3:5", "init must lie between");
    must_fail(
        HEAD
        "  - {name: a, kind: quality, define: A, min: 1, max: 2, init: 1, whole: 1}\n",
        ":3:73", "whole: unknown word \"1\"; valid: true false");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: [b], min: 1}\n",
              ":3:59", "axis \"a\" has values, so it takes no min");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: [b], init: c}\n",
              ":3:60", "a: unknown value \"c\"; did you mean \"b\"? valid: b");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: [b, b]}\n", ":3:5",
              "twice");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: []}\n", ":3:5",
              "no values");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: [[b]]}\n", ":3:50",
              "must be a map");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: [{text: b}]}\n",
              ":3:50", "a value needs a name");
    must_fail(HEAD "  - {name: stage, kind: quality, define: A, values: [b]}\n", ":3:5",
              "there is one of that name already");
    must_fail(HEAD "  - {name: a, kind: quality, define: A, values: [b], when: c=d}\n",
              ":3:5", "unknown axis \"c\"");
    must_fail("suite: x\naxes: {name: a}\n", ":2:7", "axes must be a list");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_suite)
    const struct CMUnitTest tests[] = {
        TEST(own_axes_become_rows_behind_the_builtin_ones),
        TEST(own_axes_work_in_base_sweep_cross_and_exclude),
        TEST(exclude_keeps_out_what_an_axis_needs_and_has_not),
        TEST(wrong_axes_are_refused_where_they_stand),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
