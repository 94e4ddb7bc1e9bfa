// Budgets: what is read of them, and what rows keep them.
#include "test.h"

#include "analyse/expect.h"

enum { ROWS = 3 };
static struct sb_suite suite;
static struct sb_expectation expectation[8];
static struct sb_expected expected;
static struct sb_row row[ROWS];
static struct sb_variant variant[ROWS];
static struct sb_error err;

static int set_up(void **state)
{
    (void)state;
    suite = (struct sb_suite){.name = "x", .expect = expectation};
    suite.axes = *sb_axes_builtin();
    static const char *const ids[ROWS] = {"point=1", "point=2", "point=4"};
    for (int i = 0; i < ROWS; i++) {
        sb_variant_init(&suite.axes, &variant[i]);
        sb_variant_put(&variant[i], SB_AXIS_POINT, 1 << i);
        sb_row_init(&row[i]);
        row[i].axes = &variant[i];
        row[i].variant = ids[i];
        row[i].scene = i == 2 ? "room" : "sphere";
        row[i].status = "ok";
        row[i].median_ms = 4;
        row[i].ci_lo_ms = 3.9;
        row[i].ci_hi_ms = 4.2;
        row[i].fps = 250;
        row[i].ns_per_fragment = 40;
        row[i].max_err = 2.0 / 255;
        row[i].nonfinite = 0;
    }
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    sb_expect_free(&expected);
    return 0;
}

static struct sb_expectation *expect(const char *column, const char *bound)
{
    struct sb_expectation *e = &expectation[suite.expect_count++];
    *e = (struct sb_expectation){.column = column,
                                 .column_at = "s.yaml:4:5",
                                 .bound = bound,
                                 .bound_at = "s.yaml:4:9"};
    return e;
}

static bool resolve(void)
{
    sb_expect_free(&expected);
    return sb_expect_resolve(&suite, &expected, &err);
}

// The verdict of one bound on row 0.
static enum sb_expect_verdict verdict_of(const char *column, const char *bound)
{
    suite.expect_count = 0;
    expect(column, bound);
    if (!resolve())
        fail_msg("%s", err.text);
    sb_expect_check(&expected, row, 1);
    assert_int_equal(expected.finding_count, 1);
    assert_int_equal(expected.of[expected.finding[0].verdict], 1);
    return expected.finding[0].verdict;
}

#define check_verdict(column, bound, wanted)                                             \
    do {                                                                                 \
        if (verdict_of(column, bound) != SB_EXPECT_##wanted)                             \
            fail_msg("%s %s is %s: %s", column, bound,                                   \
                     sb_expect_words[expected.finding[0].verdict],                       \
                     expected.finding[0].measured);                                      \
    } while (0)

static void refused(const char *column, const char *bound, const char *message)
{
    suite.expect_count = 0;
    expect(column, bound);
    if (resolve())
        fail_msg("%s %s was accepted", column, bound);
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, message);
}

static void values_without_an_interval_hold_or_miss(void **state)
{
    (void)state;
    check_verdict("max_err", "<= 2/255", HELD);
    check_verdict("max_err", "< 2/255", MISSED);
    check_verdict("max_err", ">= 2/255", HELD);
    check_verdict("max_err", "> 0.0078", HELD);
    check_verdict("max_err", "<=0.0078", MISSED);
    check_verdict("max_err", "  <=   1e-2", HELD);
    check_verdict("nonfinite", "0", HELD);
    check_verdict("nonfinite", "= 0", HELD);
    row[0].nonfinite = 1;
    check_verdict("nonfinite", "0", MISSED);
    row[0].psnr_db = INFINITY;
    check_verdict("psnr_db", ">= 40", HELD);
}

static void times_are_judged_by_their_interval(void **state)
{
    (void)state;
    check_verdict("median_ms", "<= 4.2", HELD);
    check_verdict("median_ms", "<= 4.1999", INCONCLUSIVE);
    check_verdict("median_ms", "< 4.2", INCONCLUSIVE);
    check_verdict("median_ms", "<= 3.9", INCONCLUSIVE);
    check_verdict("median_ms", "< 3.9", MISSED);
    check_verdict("median_ms", "<= 3.8999", MISSED);
    check_verdict("median_ms", ">= 3.9", HELD);
    check_verdict("median_ms", "> 3.9", INCONCLUSIVE);
    check_verdict("median_ms", ">= 4.3", MISSED);
    row[0].ratio = 2;
    row[0].ratio_lo = 1.9;
    row[0].ratio_hi = 2.2;
    check_verdict("ratio", "<= 2.2", HELD);
    check_verdict("ratio", "<= 2", INCONCLUSIVE);
    row[0].against_ratio = .9;
    row[0].against_lo = .8;
    row[0].against_hi = .95;
    check_verdict("against_ratio", "< 1", HELD);
    check_verdict("against_ratio", "< 0.9", INCONCLUSIVE);
}

// 4 ms within 3.9 and 4.2 are 1000 / 4.2 = 238.1 to 256.4 frames a second.
static void what_follows_the_time_has_its_interval(void **state)
{
    (void)state;
    check_verdict("fps", ">= 238", HELD);
    check_verdict("fps", ">= 239", INCONCLUSIVE);
    check_verdict("fps", ">= 256", INCONCLUSIVE);
    check_verdict("fps", ">= 257", MISSED);
    check_contains(expected.finding[0].measured, "250 (238.095 … 256.41)");
    check_verdict("ns_per_fragment", "<= 42.01", HELD);
    check_verdict("ns_per_fragment", "<= 41.9", INCONCLUSIVE);
    check_verdict("ns_per_fragment", "<= 38.9", MISSED);
}

static void a_time_without_an_interval_is_inconclusive(void **state)
{
    (void)state;
    row[0].status = "too_few_samples";
    row[0].ci_lo_ms = row[0].ci_hi_ms = NAN;
    check_verdict("median_ms", "<= 100", INCONCLUSIVE);
    check_contains(expected.finding[0].measured, "4 without an interval");
    check_verdict("nonfinite", "0", HELD);
}

static void what_was_not_measured_is_missed(void **state)
{
    (void)state;
    row[0].max_err = NAN;
    row[0].median_ms = NAN;
    row[0].nonfinite = SB_NO_COUNT;
    check_verdict("max_err", "<= 1", MISSED);
    assert_string_equal(expected.finding[0].measured, "not measured");
    check_verdict("median_ms", "<= 1", MISSED);
    check_verdict("nonfinite", "<= 1", MISSED);
    check_verdict("binary_hash", "abc", MISSED);
}

static void words_are_held_by_being_equal(void **state)
{
    (void)state;
    row[0].precision_effective = "fp16";
    check_verdict("precision_effective", "fp16", HELD);
    check_verdict("precision_effective", "= fp16", HELD);
    check_verdict("precision_effective", "fp1", MISSED);
    check_verdict("status", "ok", HELD);
}

static void a_row_whose_status_fails_misses_all_but_what_is_said_of_it(void **state)
{
    (void)state;
    row[0].status = "dead_light";
    check_verdict("nonfinite", "0", MISSED);
    assert_string_equal(expected.finding[0].measured, "0, and the row is dead_light");
    check_verdict("median_ms", "<= 100", MISSED);
    check_verdict("status", "dead_light", HELD);
    check_verdict("status", "ok", MISSED);
    row[0].status = "not_fragment_bound"; // valid all the same
    check_verdict("nonfinite", "0", HELD);
}

static void rules_judge_the_rows_that_they_name_and_no_others(void **state)
{
    (void)state;
    static const double points[] = {1, 4}, all[] = {1, 2, 4, 8},
                        vertex[] = {SB_STAGE_VERTEX};
    static const struct sb_expect_axis conditions[] = {
        {SB_AXIS_POINT, points, 2}, {SB_AXIS_POINT, all, 4}, {SB_AXIS_STAGE, vertex, 1}};
    static const char *const scenes[] = {"hall", "sphere"};
    struct sb_expectation *e = expect("nonfinite", "0");
    e->axis = &conditions[0];
    e->axis_count = 1;
    e = expect("nonfinite", "0");
    e->axis = &conditions[0];
    e->axis_count = 1;
    e->scene = scenes;
    e->scene_count = 2;
    expect("nonfinite", "0");
    e = expect("nonfinite", "0");
    e->axis = &conditions[1];
    e->axis_count = 2; // and: no row is per vertex
    assert_true(resolve());
    sb_expect_check(&expected, row, ROWS);
    static const struct {
        int rule, row;
    } wanted[] = {{0, 0}, {0, 2}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {3, -1}};
    assert_int_equal(expected.finding_count, 7);
    for (int i = 0; i < 7; i++) {
        assert_ptr_equal(expected.finding[i].rule, &expected.rule[wanted[i].rule]);
        if (wanted[i].row >= 0)
            assert_ptr_equal(expected.finding[i].row, &row[wanted[i].row]);
    }
    assert_null(expected.finding[6].row);
    assert_int_equal(expected.of[SB_EXPECT_HELD], 6);
    assert_int_equal(expected.of[SB_EXPECT_MISSED], 1);
}

static void bounds_that_are_none_are_answered_where_they_stand(void **state)
{
    (void)state;
    refused("max_er", "<= 1",
            "s.yaml:4:5: unknown column \"max_er\"; did you mean \"max_err\"? valid: ");
    refused("case", "1", "unknown column \"case\"");
    refused("point", "1", "s.yaml:4:5: \"point\" is an axis; it goes under where");
    static const char *const bad[] = {
        "",      "<=",   "=< 4",       "<= four", "~ 4",   "4 ms",   "<= 1/",  "<= 1/0",
        "<= /2", "!= 4", "<= 2/255/3", "== 4",    "<= 2%", "<= inf", "<= nan", "4 <"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        refused("max_err", bad[i], "\" is no bound; valid: one of <= >= < > = and");
    refused("max_err", "<= four", "s.yaml:4:9: max_err: \"<= four\"");
    refused("median_ms", "4", "a measured interval equals no number");
    refused("fps", "= 60", "a measured interval equals no number");
    refused("status", "<= ok", "a word is wanted");
    refused("status", "", "a word is wanted");
}

static void lines_say_what_was_expected_of_which_row_and_what_was_measured(void **state)
{
    (void)state;
    struct sb_text text = {0};
    check_verdict("max_err", "<=  1/255", MISSED);
    sb_expect_text(&expected.finding[0], &text);
    assert_string_equal(sb_text_get(&text),
                        "max_err <= 1/255 of sphere point=1: 0.00784314 (s.yaml:4:9)");
    static const double none[] = {64};
    static const struct sb_expect_axis nowhere = {SB_AXIS_POINT, none, 1};
    expectation[0].axis = &nowhere;
    expectation[0].axis_count = 1;
    assert_true(resolve());
    sb_expect_check(&expected, row, ROWS);
    sb_text_clear(&text);
    sb_expect_text(&expected.finding[0], &text);
    assert_string_equal(sb_text_get(&text),
                        "max_err <= 1/255: it names no row (s.yaml:4:9)");
    sb_text_free(&text);
}

// What is shipped must not fail for a slip in its expectations.
static void shipped_suites_expect_columns_that_there_are(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    struct sb_suite shipped = {0};
    struct sb_expected rules = {0};
    const struct sb_suite_params params = {.path = SB_SOURCE_DIR "/bench/ci.yaml",
                                           .data_dir = SB_SOURCE_DIR};
    if (!sb_suite_load(&params, &shipped, &err) ||
        !sb_expect_resolve(&shipped, &rules, &err))
        fail_msg("%s", err.text);
    assert_true(rules.rule_count > 0);
    sb_expect_free(&rules);
    sb_suite_free(&shipped);
    sb_arena_free(&arena);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(values_without_an_interval_hold_or_miss),
        TEST(times_are_judged_by_their_interval),
        TEST(what_follows_the_time_has_its_interval),
        TEST(a_time_without_an_interval_is_inconclusive),
        TEST(what_was_not_measured_is_missed),
        TEST(words_are_held_by_being_equal),
        TEST(a_row_whose_status_fails_misses_all_but_what_is_said_of_it),
        TEST(rules_judge_the_rows_that_they_name_and_no_others),
        TEST(bounds_that_are_none_are_answered_where_they_stand),
        TEST(lines_say_what_was_expected_of_which_row_and_what_was_measured),
        TEST(shipped_suites_expect_columns_that_there_are),
    };
    return run_tests(tests);
}
