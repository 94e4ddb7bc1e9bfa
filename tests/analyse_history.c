// Levels and creeps of made-up histories.
#include "history_rows.h"

#include "analyse/history.h"
#include "math/random.h"
#include "noise.h"

static struct sb_history_analysis analysis;

static int start(void **state)
{
    (void)state;
    history_count = 0;
    return 0;
}

static int stop(void **state)
{
    (void)state;
    sb_history_analysis_free(&analysis);
    return 0;
}

static void analyse_with(const char *pattern, double tolerance, int recent)
{
    sb_history_analysis_free(&analysis);
    sb_history_analyse(
        &(struct sb_history_params){
            .row = history_row,
            .count = history_count,
            .pattern = pattern,
            .tolerance = tolerance,
            .recent = recent,
        },
        &analysis);
}

static const struct sb_history_series *only_series(void)
{
    analyse_with(NULL, 0.02, 10);
    assert_int_equal(analysis.count, 1);
    return &analysis.series[0];
}

// --- levels ------------------------------------------------------------------------------------

static void a_step_is_found_between_its_commits(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(7);
    for (int i = 0; i < 40; i++)
        add_ratio(i, (i < 25 ? 0.5 : 0.515) * (1 + 0.003 * normal_noise(&random)));
    const struct sb_history_series *series = only_series();
    assert_int_equal(series->point_count, 40);
    assert_int_equal(series->segment_count, 2);
    assert_string_equal(series->point[series->segment[1].start].commit, "c025");
    check_close(series->segment[1].step, 1.03, 0.004);
    check_close(series->creep, 0.03, 0.004);
    assert_true(series->crept);
}

static void noise_alone_has_one_level(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(1);
    for (int i = 0; i < 200; i++)
        add_ratio(i, 2 * (1 + 0.008 * spiky_noise(&random)));
    const struct sb_history_series *series = only_series();
    assert_int_equal(series->segment_count, 1);
    check_close(series->creep, 0, 0);
    assert_false(series->crept || series->recent);
}

// Half a percent in each of ten commits: none of them is a step that a gate of 2 % sees.
static void a_creep_of_half_a_percent_in_each_of_ten_commits_is_seen(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(3);
    for (int i = 0; i < 40; i++) {
        const int crept = i < 15 ? 0 : i < 25 ? i - 14 : 10;
        add_ratio(i, 0.8 * pow(1.005, crept) * (1 + 0.002 * normal_noise(&random)));
    }
    const struct sb_history_series *series = only_series();
    assert_in_range(series->segment_count, 2, 4);
    check_close(series->creep, pow(1.005, 10) - 1, 0.006);
    assert_true(series->crept);
    for (int s = 1; s < series->segment_count; s++)
        assert_true(series->segment[s].step > 1.02);
    // The creep alone, as it goes on: five commits are a level at least.
    history_count = 0;
    for (int i = 0; i < 10; i++)
        add_ratio(i, pow(1.005, i));
    series = only_series();
    assert_int_equal(series->segment_count, 2);
    assert_true(series->crept);
    check_close(series->creep, pow(1.005, 5) - 1, 1e-9); // medians of five and five
}

static void what_became_faster_has_not_crept(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++)
        add_ratio(i, i < 10 ? 1 : 0.9);
    const struct sb_history_series *series = only_series();
    assert_int_equal(series->segment_count, 2);
    check_close(series->creep, -0.1, 1e-12);
    assert_false(series->crept || series->recent);
}

// A cure hides the first level, but a later step up is a step up.
static void a_step_up_is_recent_for_as_long_as_it_is(void **state)
{
    (void)state;
    for (int i = 0; i < 30; i++)
        add_ratio(i, i < 10 ? 1 : i < 20 ? 0.8 : 0.9);
    const struct sb_history_series *series = only_series();
    assert_int_equal(series->segment_count, 3);
    assert_false(series->crept);
    assert_true(series->recent); // at the tenth commit from the end
    analyse_with(NULL, 0.02, 9);
    assert_false(analysis.series[0].recent);
}

static void the_tolerance_is_what_is_no_change(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++)
        add_ratio(i, i < 10 ? 1 : 1.04);
    analyse_with(NULL, 0.05, 10);
    assert_int_equal(analysis.series[0].segment_count, 1);
    assert_false(analysis.series[0].crept);
    analyse_with(NULL, 0.03, 10);
    assert_int_equal(analysis.series[0].segment_count, 2);
    assert_true(analysis.series[0].crept);
}

// --- series ------------------------------------------------------------------------------------

static void rows_that_differ_in_what_costs_depends_on_are_never_joined(void **state)
{
    (void)state;
    static const size_t cells[] = {
        offsetof(struct sb_history_row, scene),
        offsetof(struct sb_history_row, variant),
        offsetof(struct sb_history_row, metric),
        offsetof(struct sb_history_row, anchor),
        offsetof(struct sb_history_row, renderer),
        offsetof(struct sb_history_row, version),
        offsetof(struct sb_history_row, threads),
    };
    for (size_t c = 0; c < sizeof cells / sizeof *cells; c++)
        for (int missing = 0; missing < 2; missing++) {
            history_count = 0;
            for (int i = 0; i < 20; i++) {
                struct sb_history_row *row = add_ratio(i, i < 10 ? 1 : 1.5);
                if (i >= 10)
                    *(const char **)((char *)row + cells[c]) =
                        missing && cells[c] > cells[1] ? NULL : "another";
            }
            analyse_with(NULL, 0.02, 10);
            assert_int_equal(analysis.count, 2);
            for (int s = 0; s < 2; s++) {
                assert_int_equal(analysis.series[s].point_count, 10);
                assert_int_equal(analysis.series[s].segment_count, 1);
                assert_false(analysis.series[s].crept || analysis.series[s].recent);
            }
        }
}

// What is only told along does not divide a series.
static void suites_and_sources_do_not_divide_a_series(void **state)
{
    (void)state;
    for (int i = 0; i < 10; i++) {
        struct sb_history_row *row = add_ratio(i, 1);
        row->suite = i < 5 ? "ci" : "nightly";
        row->source_hash = history_text[i][1];
        row->pairs = 60 + i;
    }
    assert_int_equal(only_series()->point_count, 10);
}

static void a_commit_that_was_measured_again_is_the_median_of_its_rows(void **state)
{
    (void)state;
    static const double ratios[] = {1.02, 1.5, 1.0};
    for (int i = 0; i < 8; i++)
        add_ratio(i, 1);
    for (int k = 0; k < 3; k++) // later than all others, but of the third commit
        add_ratio(20 + k, ratios[k])->commit = "c002";
    const struct sb_history_series *series = only_series();
    assert_int_equal(series->point_count, 8);
    assert_int_equal(series->rows, 11);
    assert_string_equal(series->point[2].commit, "c002");
    assert_int_equal(series->point[2].rows, 4);
    check_close(series->point[2].ratio, 1.01, 1e-12); // of 1, 1, 1.02 and 1.5
    assert_string_equal(series->point[2].time, "2026-01-03T00:00:00Z");
}

static void commits_are_in_the_order_of_their_times(void **state)
{
    (void)state;
    static const int order[] = {3, 0, 2, 1};
    for (int i = 0; i < 4; i++)
        add_ratio(order[i], 1 + order[i]);
    // Of one time: as they stand.
    history_row[1].time = history_row[2].time = history_row[3].time;
    const struct sb_history_series *series = only_series();
    static const char *const wanted[] = {"c000", "c002", "c001", "c003"};
    for (int i = 0; i < 4; i++)
        assert_string_equal(series->point[i].commit, wanted[i]);
}

static void rows_without_a_ratio_are_counted_and_left_out(void **state)
{
    (void)state;
    for (int i = 0; i < 6; i++)
        add_ratio(i, 1);
    history_row[2].ratio = NAN;
    history_row[2].status = "compile_failed";
    const struct sb_history_series *series = only_series();
    assert_int_equal(series->point_count, 5);
    assert_int_equal(series->failed, 1);
    for (int i = 0; i < 6; i++)
        history_row[i].ratio = NAN;
    series = only_series();
    assert_int_equal(series->point_count, 0);
    assert_int_equal(series->segment_count, 0);
    assert_true(isnan(series->creep));
    assert_false(series->crept);
}

static void a_pattern_chooses_variants_with_or_without_the_scene(void **state)
{
    (void)state;
    add_ratio(0, 1);
    add_ratio(0, 1)->variant = "spot=4";
    add_ratio(0, 1)->scene = "room";
    static const struct {
        const char *pattern;
        int count;
    } patterns[] = {{NULL, 3},       {"*", 3},      {"point=4*", 2}, {"room/*", 1},
                    {"*/point*", 2}, {"spot=4", 1}, {"spot=5", 0}};
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        analyse_with(patterns[i].pattern, 0.02, 10);
        assert_int_equal(analysis.count, patterns[i].count);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, start, stop)
    const struct CMUnitTest tests[] = {
        TEST(a_step_is_found_between_its_commits),
        TEST(noise_alone_has_one_level),
        TEST(a_creep_of_half_a_percent_in_each_of_ten_commits_is_seen),
        TEST(what_became_faster_has_not_crept),
        TEST(a_step_up_is_recent_for_as_long_as_it_is),
        TEST(the_tolerance_is_what_is_no_change),
        TEST(rows_that_differ_in_what_costs_depends_on_are_never_joined),
        TEST(suites_and_sources_do_not_divide_a_series),
        TEST(a_commit_that_was_measured_again_is_the_median_of_its_rows),
        TEST(commits_are_in_the_order_of_their_times),
        TEST(rows_without_a_ratio_are_counted_and_left_out),
        TEST(a_pattern_chooses_variants_with_or_without_the_scene),
    };
#undef TEST
    return run_tests(tests);
}
