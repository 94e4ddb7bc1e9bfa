// A plan over several platforms is a run of each, and one summary of all.
#include "cli_running.h"

#include "base/clock.h"

#define PLAN "run -q --context null --rounds 20 --set point=1 --cross api=gl,gles "

static void each_platform_has_a_folder_and_all_have_a_summary(void **state)
{
    (void)state;
    struct sb_csv csv = {0};
    check_answer(PLAN "--cross stage=fragment,vertex -o @/two", 0,
                 "results of all platforms: ");
    read_csv("two/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 4);
    assert_string_equal(csv_cell(&csv, 1, "api"), "gl");
    assert_string_equal(csv_cell(&csv, 2, "api"), "gl");
    assert_string_equal(csv_cell(&csv, 3, "api"), "gles");
    assert_string_equal(csv_cell(&csv, 4, "stage"), "vertex");
    sb_csv_free(&csv);
    read_csv("two/api=gles/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 2);
    sb_csv_free(&csv);
    assert_true(run_is_complete("two/api=gl/run.json"));
    check_answer("compare --pareto @/two", 0, "api=gles");
}

static void a_platform_is_gone_on_with_by_itself(void **state)
{
    (void)state;
    check_answer("run -q --resume @/two/api=gles", 0, "vertex");
}

static void a_folder_of_several_is_not_written_over(void **state)
{
    (void)state;
    char *before = read_file("two/summary.csv");
    check_answer(PLAN "-o @/two", 2,
                 "holds results already; name another folder with -o");
    check_answer(PLAN "-o @/two", 2, "or go on with it: run --resume ");
    check_answer(PLAN "--platform api=gles -o @/two", 2, "run.json exists; name another");
    check_answer("run --resume @/two --platform api=gles", 2, "leave out --platform");
    char *after = read_file("two/summary.csv");
    assert_string_equal(before, after);
    free(before);
    free(after);
}

// Axes of the suite's own, the machine and whether it is complete are those of any other folder.
static void the_folder_of_all_is_one_that_other_commands_read(void **state)
{
    (void)state;
    write_file("own.yaml",
               "suite: own\n"
               "axes:\n"
               "  - {name: knob, kind: quality, define: KNOB, min: 0, max: 9, init: 0, "
               "help: mine}\n"
               "base: {point: 1}\ncross: {api: [gl, gles], knob: [1, 2]}\n");
    check_answer("run @/own.yaml -q --context null --rounds 20 -o @/own", 0,
                 "results of");
    check_answer("compare --pareto @/own", 0, "knob");
    check_answer("compare @/own @/own", 0, " 0 refused\n");
    check_shell("$SB compare @/own @/own 2>&1 | grep -c 'its machine is not known'", 1,
                "0\n");
    check_shell("cp -r @/own @/told && sed -i 's/\"environment\": {/&\"LP_NUM_THREADS\":"
                " \"3\",/' @/told/run.json",
                0, "");
    check_answer("compare @/told @/own", 2, ": LP_NUM_THREADS 3 | none");
}

// --- interrupted --------------------------------------------------------------------------------

#define ENDLESS                                                                          \
    "run --context null --set point=1 --cross api=gl,gles --rounds 1000000 "             \
    "--half-width 0.0001 --budget 60 "

static struct running it;

// Only the run of the first platform is there when its parent alone is told to stop.
static void stop_at(const char *stage, int number, const char *words)
{
    start_program(&it, words);
    wait_until_said(&it, stage);
    kill(it.pid, number);
}

static void what_is_told_to_stop_tells_the_run_that_it_waits_for(void **state)
{
    (void)state;
    struct sb_csv csv;
    stop_at("round 200", SIGTERM, ENDLESS "-o @/stopped");
    assert_int_equal(finish(&it), 130);
    check_contains(it.text, "interrupted; go on with: shadebench run --resume ");
    char part[128]; // one platform gone on with leaves the whole as it is
    snprintf(part, sizeof part, "--resume %s/stopped/api", test_dir);
    assert_null(strstr(it.text, part));
    assert_false(run_is_complete("stopped/api=gl/run.json"));
    read_csv("stopped/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 1);
    assert_string_equal(csv_cell(&csv, 1, "stop"), "interrupted");
    assert_true(atoi(csv_cell(&csv, 1, "rounds")) >= 200);
    sb_csv_free(&csv);
}

static void the_whole_is_gone_on_with(void **state)
{
    (void)state;
    struct sb_csv csv;
    check_answer("compare --pareto @/stopped", 0,
                 "0 of its 2 platforms were measured to the end; go on with: shadebench "
                 "run --resume ");
    check_answer("run -q --resume @/stopped --rounds 20 --first-look 10", 0,
                 "results of all platforms: ");
    read_csv("stopped/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 2);
    assert_string_equal(csv_cell(&csv, 1, "processes"), "2");
    assert_string_equal(csv_cell(&csv, 2, "api"), "gles");
    assert_string_equal(csv_cell(&csv, 2, "status"), "ok");
    sb_csv_free(&csv);
    assert_true(run_is_complete("stopped/api=gl/run.json"));
    check_shell("$SB compare --pareto @/stopped 2>&1 | grep -c incomplete", 1, "0\n");
    // More processes are asked of all of them.
    check_answer("run -q --resume @/stopped --processes 3", 0, "results of all");
    read_csv("stopped/summary.csv", &csv);
    assert_string_equal(csv_cell(&csv, 2, "processes"), "3");
    sb_csv_free(&csv);
}

// The suite may have changed since: a platform whose turn comes later takes the copy.
static void a_platform_that_was_not_begun_is_begun_with_the_suite_of_then(void **state)
{
    (void)state;
    struct sb_csv csv;
    write_file("later.yaml",
               "suite: later\nbase: {point: 1}\ncross: {api: [gl, gles]}\n");
    stop_at("round 100", SIGTERM,
            "run @/later.yaml --context null --rounds 1000000 --half-width 0.0001 "
            "--budget 60 -o @/later");
    assert_int_equal(finish(&it), 130);
    write_file("later.yaml",
               "suite: later\nbase: {point: 2}\ncross: {api: [gl, gles]}\n");
    check_answer("run -q --resume @/later --rounds 20 --first-look 10", 0,
                 "results of all platforms: ");
    read_csv("later/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 2);
    assert_string_equal(csv_cell(&csv, 2, "point"), "1");
    sb_csv_free(&csv);
}

// Nothing of the parent can run at a SIGKILL. The terminal ends with the last that has it open.
static void a_run_ends_soon_after_the_parent_that_was_killed(void **state)
{
    (void)state;
    stop_at("round 200", SIGKILL, ENDLESS "-o @/orphan");
    const int64_t killed = sb_clock_ns();
    assert_int_equal(finish(&it), 128 + SIGKILL);
    assert_true(sb_clock_ns() - killed < INT64_C(20000000000));
    assert_false(run_is_complete("orphan/api=gl/run.json"));
    struct sb_csv csv;
    read_csv("orphan/api=gl/summary.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "stop"), "interrupted");
    sb_csv_free(&csv);
    check_answer("run -q --resume @/orphan --rounds 20 --first-look 10", 0,
                 "results of all platforms: ");
}

static void one_of_them_can_be_asked_for(void **state)
{
    (void)state;
    struct sb_csv csv = {0};
    check_answer(PLAN "--platform api=gles -o @/one", 0, "results: ");
    read_csv("one/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 1);
    assert_string_equal(csv_cell(&csv, 1, "api"), "gles");
    sb_csv_free(&csv);
    check_answer(PLAN "--platform api=gle -o @/none", 2,
                 "unknown platform \"api=gle\"; did you mean \"api=gl\"? valid: api=gl "
                 "api=gles");
}

static void json_is_of_all_of_them(void **state)
{
    (void)state;
    json_t *object = run_json(PLAN "--json -o @/json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "rows")), 2);
    json_decref(object);
}

static void budgets_are_held_against_all_of_them(void **state)
{
    (void)state;
    write_file("budget.yaml",
               "suite: budget\nbase: {point: 1}\ncross: {api: [gl, gles]}\n"
               "expect:\n  - {where: {api: gles}, median_ms: \"<= 1e-9\"}\n"
               "  - {where: {api: gl}, nonfinite: 0}\n");
    check_answer("run @/budget.yaml -q --context null --rounds 20 --check -o @/budget", 1,
                 "expected: 1 held, 1 missed");
}

static void what_no_platform_can_have_is_told_by_the_exit_code(void **state)
{
    (void)state;
    check_answer(PLAN "--worker /no/such/worker -o @/lost", 3,
                 "there is no such command");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_platform_has_a_folder_and_all_have_a_summary),
        cmocka_unit_test(a_platform_is_gone_on_with_by_itself),
        cmocka_unit_test(a_folder_of_several_is_not_written_over),
        cmocka_unit_test(the_folder_of_all_is_one_that_other_commands_read),
        cmocka_unit_test(what_is_told_to_stop_tells_the_run_that_it_waits_for),
        cmocka_unit_test(the_whole_is_gone_on_with),
        cmocka_unit_test(a_platform_that_was_not_begun_is_begun_with_the_suite_of_then),
        cmocka_unit_test(a_run_ends_soon_after_the_parent_that_was_killed),
        cmocka_unit_test(one_of_them_can_be_asked_for),
        cmocka_unit_test(json_is_of_all_of_them),
        cmocka_unit_test(budgets_are_held_against_all_of_them),
        cmocka_unit_test(what_no_platform_can_have_is_told_by_the_exit_code),
    };
    begin_tests();
    return end_tests(run_tests(tests));
}
