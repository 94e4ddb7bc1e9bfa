// Going on with a results folder: which variants are measured again, and on which driver.
#include "measure_fixture.h"

#define SETTINGS(...)                                                                    \
    (const char *const[]){__VA_ARGS__},                                                  \
        (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

// How many lights' variants are noisy: point > *user.
static double noisy_above(void *user, const struct sb_job *job,
                          const struct sb_shot *shot, int64_t count)
{
    (void)shot;
    const bool noisy = job->variant.value[SB_AXIS_POINT] > *(const double *)user;
    return 1e6 * (1 + (noisy ? 0.5 : 0.001) * sin((double)count * 1.7));
}

// As a kill leaves it: the last process is not complete.
static void mark_last_process(const struct fixture *f, bool complete)
{
    struct sb_error err = {0};
    char path[128];
    json_t *run = sb_store_read_run(f->dir, &err);
    assert_non_null(run);
    const json_t *list = json_object_get(run, "processes");
    json_object_set_new(json_array_get(list, json_array_size(list) - 1), "complete",
                        json_boolean(complete));
    snprintf(path, sizeof path, "%s/run.json", f->dir);
    assert_int_equal(json_dump_file(run, path, 0), 0);
    json_decref(run);
}

// Samples of a process, by point lights.
static void count_samples(const struct fixture *f, int process, int count[8])
{
    struct sb_csv csv;
    fixture_samples(f, &csv);
    memset(count, 0, 8 * sizeof *count);
    const int column = sb_csv_column(&csv, "process");
    const int variant = sb_csv_column(&csv, "variant");
    for (int i = 1; i < csv.row_count; i++)
        if (atoi(csv.cell[i][column]) == process)
            count[csv.cell[i][variant][strlen("point=")] - '0']++;
    sb_csv_free(&csv);
}

static void what_interrupted_processes_finished_is_not_measured_again(void **state)
{
    (void)state;
    struct fixture f;
    int count[8];
    double precise = 2;
    next_script.frame_ns = noisy_above;
    next_script.user = &precise;
    fixture_begin(&f, "1..4", SETTINGS("first_look", "10", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    mark_last_process(&f, false);

    precise = 3;
    assert_true(fixture_run(&f, true));
    count_samples(&f, 1, count);
    assert_true(count[1] > 0); // the anchor, though it was precise
    assert_int_equal(count[2], 0);
    assert_true(count[3] > 0);
    assert_true(count[4] > 0);
    mark_last_process(&f, false);

    // Interrupted again: 2 was finished in process 0, 3 in process 1.
    precise = 4;
    assert_true(fixture_run(&f, true));
    count_samples(&f, 2, count);
    assert_true(count[1] > 0);
    assert_int_equal(count[2], 0);
    assert_int_equal(count[3], 0);
    assert_true(count[4] > 0);
    assert_int_equal(f.result.processes_done, 1);
    fixture_end(&f);
}

static void the_process_after_a_complete_one_measures_all(void **state)
{
    (void)state;
    struct fixture f;
    int count[8];
    double precise = 9;
    next_script.frame_ns = noisy_above;
    next_script.user = &precise;
    fixture_begin(&f, "1,2",
                  SETTINGS("first_look", "10", "rounds", "20", "processes", "2"));
    assert_true(fixture_run(&f, false));
    assert_true(fixture_run(&f, true));
    assert_int_equal(f.result.processes_done, 2);
    count_samples(&f, 1, count);
    assert_true(count[1] > 0);
    assert_int_equal(count[1], count[2]);
    fixture_end(&f);
}

static void a_complete_folder_opens_no_driver(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_text log = {0};
    fixture_begin(&f, "1,2", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    const double median = f.result.row[1].median_ms, ratio = f.result.row[1].ratio;
    const double storage = f.result.row[1].axes->value[SB_AXIS_STORAGE];
    char source_hash[32];
    snprintf(source_hash, sizeof source_hash, "%s", f.result.row[1].source_hash);

    next_script.log = &log;
    if (!fixture_run(&f, true))
        fail_msg("%s", f.err.text);
    assert_null(log.data);
    assert_int_equal(f.result.row_count, 2);
    assert_int_equal(f.result.processes_done, 1);
    assert_int_equal(f.result.exit_code, 0);
    check_close(f.result.row[1].median_ms, median, 0);
    check_close(f.result.row[1].ratio, ratio, 0);
    // Axes as they were drawn, not as they were asked for.
    check_close(f.result.row[1].axes->value[SB_AXIS_STORAGE], storage, 0);
    check_close(f.result.row[1].axes->value[SB_AXIS_POINT], 2, 0);
    assert_string_equal(f.result.row[1].source_hash, source_hash);
    assert_string_equal(f.result.row[1].variant, "point=2");
    fixture_end(&f);
}

static void a_complete_folder_whose_summary_is_damaged_is_refused(void **state)
{
    (void)state;
    static const char *const damage[][2] = {
        {"s/,ok,/,okay,/", "damaged"},
        {"3d", "1 rows"},
        {"2s/point=1/point=9/", "damaged"},
        {"2s/,rgba8,/,rgba9,/", "rgba9"},
        {"2s/null (scripted[^\"]*//", "damaged"},
        {"2s/,2.*e/,2e/", "fields"},
    };
    for (size_t i = 0; i < sizeof damage / sizeof *damage; i++) {
        struct fixture f;
        char command[256];
        fixture_begin(&f, "1,2", SETTINGS("first_look", "20", "rounds", "20"));
        assert_true(fixture_run(&f, false));
        snprintf(command, sizeof command, "sed -i '%s' %s/summary.csv", damage[i][0],
                 f.dir);
        assert_int_equal(system(command), 0);
        if (fixture_run(&f, true) || !strstr(f.err.text, damage[i][1]))
            fail_msg("%s: %s", damage[i][0], f.err.text);
        check_contains(f.err.text, "summary.csv");
        fixture_end(&f);
    }
}

static void *open_renamed(const struct sb_context_params *params, struct sb_caps *caps,
                          struct sb_error *err)
{
    void *runner = sb_runner_null.open(params, caps, err);
    strcpy(caps->version, "another");
    return runner;
}

static void another_driver_is_refused(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_csv before, after;
    fixture_begin(&f, "1", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    fixture_samples(&f, &before);
    assert_true(sb_measure_set(&f.suite.measure, "processes", "2", &f.err));

    struct sb_runner_fns runner = sb_runner_null;
    runner.open = open_renamed;
    const struct sb_run_params params = {
        .suite = &f.suite,
        .driver = {.runner = &runner, .context = {.context = "null", .device = -1}},
        .data_dir = SB_SOURCE_DIR,
        .dir = f.dir,
        .append = true,
    };
    sb_run_result_free(&f.result);
    assert_false(sb_run(&params, &f.result, &f.err));
    assert_int_equal(f.err.status, SB_BAD_INPUT);
    check_contains(f.err.text, "here is \"null (scripted, nothing is drawn), another\"");
    fixture_samples(&f, &after);
    assert_int_equal(before.row_count, after.row_count);
    sb_csv_free(&before);
    sb_csv_free(&after);
    fixture_end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_interrupted_processes_finished_is_not_measured_again),
        cmocka_unit_test(the_process_after_a_complete_one_measures_all),
        cmocka_unit_test(a_complete_folder_opens_no_driver),
        cmocka_unit_test(a_complete_folder_whose_summary_is_damaged_is_refused),
        cmocka_unit_test(another_driver_is_refused),
    };
    return run_tests(tests);
}
