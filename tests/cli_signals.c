// A run that is stopped by a signal says so, keeps its rounds, and can be gone on with.
#include "cli_running.h"

// Measures until it is stopped.
#define ENDLESS                                                                          \
    "run --context null --sweep point=1,2,4 --rounds 1000000 --half-width 0.0001 "       \
    "--budget 100000 "

static struct running it;

static void check_interrupted(const char *arguments, const char *stage, int number,
                              const char *record)
{
    start_program(&it, arguments);
    wait_until_said(&it, stage);
    kill(it.pid, number);
    assert_int_equal(finish(&it), 130);
    check_contains(it.text, "interrupted; go on with: shadebench run --resume ");
    assert_false(run_is_complete(record));
}

static void every_stage_ends_with_130_and_an_incomplete_record(void **state)
{
    (void)state;
    check_interrupted(ENDLESS "-o @/a", "auditing", SIGINT, "a/run.json");
    check_interrupted(ENDLESS "-o @/b", "compiling", SIGTERM, "b/run.json");
    check_interrupted(ENDLESS "-o @/c", "checking", SIGINT, "c/run.json");
    check_interrupted(ENDLESS "-o @/d", "calibrating", SIGHUP, "d/run.json");
    check_interrupted(ENDLESS "-o @/e", "round 100", SIGINT, "e/run.json");
}

static void a_run_stopped_in_its_rounds_shows_them(void **state)
{
    (void)state;
    struct sb_csv csv;
    check_interrupted(ENDLESS "-o @/rounds", "round 200", SIGTERM, "rounds/run.json");
    check_contains(it.text, "median ms");
    read_csv("rounds/summary.csv", &csv);
    for (int i = 1; i <= 3; i++) {
        assert_string_equal(csv_cell(&csv, i, "stop"), "interrupted");
        assert_string_equal(csv_cell(&csv, i, "status"), "ok");
        assert_true(atoi(csv_cell(&csv, i, "rounds")) >= 200);
    }
    sb_csv_free(&csv);
}

static void hard_cases_that_were_asked_before_a_signal_are_kept(void **state)
{
    (void)state;
    struct sb_csv csv;
    start_program(&it, "verify relations --all --context null -o @/early");
    wait_until_said(&it, "opening");
    kill(it.pid, SIGINT);
    assert_int_equal(finish(&it), 130);
    check_contains(it.text, "interrupted: what was asked before is in the files");
    // Whatever the null runner is asked in a search is wrong: that weighs more than the signal, where
    // it came to asking anything.
    start_program(&it,
                  "verify light-order --precision highp --search 100000 --context null "
                  "-o @/late");
    wait_until_said(&it, "searching");
    kill(it.pid, SIGTERM);
    const int code = finish(&it);
    assert_int_equal(code, strstr(it.text, ".id = \"found-1\"") ? 1 : 130);
    check_contains(it.text, "interrupted: ");
    check_contains(it.text, "1 case: 1 of 1 robust cells hold");
    read_csv("late/cases.csv", &csv);
    assert_int_equal(csv.row_count, 2);
    sb_csv_free(&csv);
}

static void an_interrupted_run_is_gone_on_with(void **state)
{
    (void)state;
    struct sb_csv csv;
    check_interrupted(ENDLESS "-o @/on", "round 100", SIGINT, "on/run.json");
    // Shares that were reached in the first process: only the anchor is measured again.
    check_answer("run --resume @/on --half-width 0.5 --first-look 10 -q", 0, "median ms");
    assert_true(run_is_complete("on/run.json"));
    read_csv("on/summary.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "processes"), "2");
    assert_string_equal(csv_cell(&csv, 2, "processes"), "1");
    assert_string_equal(csv_cell(&csv, 3, "processes"), "1");
    sb_csv_free(&csv);
}

// Nothing of the program can run at a SIGKILL: what is on disk is what it wrote before.
static void a_killed_run_leaves_rows_that_are_gone_on_with(void **state)
{
    (void)state;
    struct sb_csv before, after;
    start_program(&it, ENDLESS "-o @/killed");
    wait_until_said(&it, "round 300");
    kill(it.pid, SIGKILL);
    assert_int_equal(finish(&it), 128 + SIGKILL);
    assert_false(run_is_complete("killed/run.json"));
    // Half a line, as a system that goes down leaves it.
    check_shell("printf '0,99999,0,containers,\"context=null,po' >>@/killed/samples.csv",
                0, "");
    read_csv("killed/samples.csv", &before);
    check_answer("run --resume @/killed --half-width 0.5 --first-look 10 -q", 0,
                 "median ms");
    read_csv("killed/samples.csv", &after);
    assert_true(before.row_count > 3 * 300);
    assert_true(after.row_count >= before.row_count + 10);
    for (int i = 1; i < before.row_count; i++)
        for (int c = 0; c < before.column_count; c++)
            assert_string_equal(before.cell[i][c], after.cell[i][c]);
    // The anchor alone is measured again.
    for (int i = before.row_count; i < after.row_count; i++) {
        assert_string_equal(csv_cell(&after, i, "process"), "1");
        assert_string_equal(csv_cell(&after, i, "variant"), "context=null,point=1");
    }
    assert_true(run_is_complete("killed/run.json"));
    sb_csv_free(&before);
    sb_csv_free(&after);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_stage_ends_with_130_and_an_incomplete_record),
        cmocka_unit_test(a_run_stopped_in_its_rounds_shows_them),
        cmocka_unit_test(hard_cases_that_were_asked_before_a_signal_are_kept),
        cmocka_unit_test(an_interrupted_run_is_gone_on_with),
        cmocka_unit_test(a_killed_run_leaves_rows_that_are_gone_on_with),
    };
    return end_tests(run_tests(tests));
}
