// run --check, on scripted times.
#include "cli_fixture.h"

#define RUN "run --context null -q --rounds 20 --first-look 20 "

static const char head[] = "suite: budgets\nsweep: {point: [1, 8]}\nexpect:\n";

static void write_suite(const char *items)
{
    char text[1024];
    snprintf(text, sizeof text, "%s%s", head, items);
    write_file("budgets.yaml", text);
}

// Every run has a folder of its own.
static const char *run_words(const char *more)
{
    static char words[256];
    static int runs;
    snprintf(words, sizeof words, RUN "@/budgets.yaml -o @/run%d %s", ++runs, more);
    return words;
}

static void what_holds_ends_with_0(void **state)
{
    (void)state;
    static struct answer answer;
    write_suite("  - {median_ms: \"<= 1000\", nonfinite: 0}\n");
    run_program(&answer, run_words("--check"));
    assert_int_equal(answer.code, 0);
    check_contains(answer.text,
                   "\nexpected: 4 held, 0 missed, 0 inconclusive\n\nresults: ");
}

static void what_is_missed_ends_with_1_and_a_line_each(void **state)
{
    (void)state;
    static struct answer answer;
    write_suite("  - where: {point: 8}\n    median_ms: \"<= 1e-6\"\n"
                "  - {where: {point: 64}, nonfinite: 0}\n");
    run_program(&answer, run_words("--check"));
    assert_int_equal(answer.code, 1);
    check_contains(answer.text, "\nexpected: 0 held, 2 missed, 0 inconclusive\n");
    check_contains(answer.text,
                   "\nmissed: median_ms <= 1e-6 of containers context=null,point=8: 0.");
    check_contains(answer.text, "/budgets.yaml:5:16)\n");
    check_contains(answer.text, "\nmissed: nonfinite = 0: it names no row (");
}

// Its median lies between the ends of its interval, which 20 rounds of 2 % noise keep apart.
static void what_is_inconclusive_fails_only_where_it_is_asked_to(void **state)
{
    (void)state;
    static struct answer answer;
    struct sb_csv csv;
    write_suite("  - {nonfinite: 0}\n");
    check_answer(run_words("-o @/first --check"), 0, "2 held");
    read_csv("first/summary.csv", &csv);
    char item[128];
    snprintf(item, sizeof item, "  - {where: {point: 8}, median_ms: \"<= %s\"}\n",
             csv_cell(&csv, 2, "median_ms"));
    sb_csv_free(&csv);
    write_suite(item);
    run_program(&answer, run_words("--check"));
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "\nexpected: 0 held, 0 missed, 1 inconclusive\n");
    check_contains(answer.text, "\ninconclusive: median_ms <= 0.");
    check_answer(run_words("--check --fail-on-inconclusive"), 4, "1 inconclusive");
}

static void without_check_nothing_is_judged(void **state)
{
    (void)state;
    static struct answer answer;
    write_suite("  - {median_ms: \"<= 1e-6\"}\n");
    run_program(&answer, run_words(""));
    assert_int_equal(answer.code, 0);
    assert_null(strstr(answer.text, "expected"));
}

static void slips_are_answered_before_anything_is_measured(void **state)
{
    (void)state;
    write_suite("  - {median: \"<= 4\"}\n");
    check_answer(run_words(""), 2, "budgets.yaml:4:6: unknown column \"median\"");
    write_suite("  - {max_err: \"=< 4\"}\n");
    check_answer(run_words("--check"), 2,
                 "budgets.yaml:4:15: max_err: \"=< 4\" is no bound");
    check_answer(RUN "-o @/none --set point=1 --check", 2, "there is nothing to check");
    check_answer(RUN "-o @/none --set point=1 --fail-on-inconclusive", 2,
                 "--fail-on-inconclusive goes with --check");
    check_shell("test -e @/none; echo $?", 0, "1\n");
}

// Errors want no timer, and have budgets all the same. A time that was not taken is not within one.
static void without_a_timer_errors_are_judged_and_times_are_not(void **state)
{
    (void)state;
    static struct answer answer;
    struct sb_csv csv;
    write_suite("  - {where: {point: 8}, median_ms: \"<= 1e-6\"}\n  - {nonfinite: 0}\n"
                "  - {where: {point: 1}, nonfinite: 7}\n");
    run_program(&answer, run_words("-o @/untimed --timer none --processes 3 --check"));
    assert_int_equal(answer.code, 1);
    check_contains(answer.text, "timer: none; pictures and errors alone");
    check_contains(answer.text, "\nexpected: 2 held, 1 missed, 1 inconclusive\n");
    check_contains(answer.text, "\nmissed: nonfinite = 7 ");
    check_contains(answer.text, "\ninconclusive: median_ms <= 1e-6 of containers "
                                "context=null,point=8: not timed");
    read_csv("untimed/summary.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 2);
    assert_string_equal(csv_cell(&csv, 2, "status"), "accuracy_only");
    assert_string_equal(csv_cell(&csv, 2, "timer_source"), "none");
    assert_string_equal(csv_cell(&csv, 2, "median_ms"), "");
    sb_csv_free(&csv);
    read_csv("untimed/samples.csv", &csv);
    assert_int_equal(csv.row_count, 1);
    sb_csv_free(&csv);
    check_answer("run --resume @/untimed", 1, "timer: none");
}

// The first start's arguments and the suite's copy have all that is needed.
static void the_last_process_judges_and_so_does_a_resumed_run(void **state)
{
    (void)state;
    static struct answer answer;
    write_suite("  - {median_ms: \"<= 1e-6\"}\n");
    run_program(&answer, RUN "@/budgets.yaml -o @/two --processes 2 --check");
    assert_int_equal(answer.code, 1);
    check_contains(answer.text, "\nexpected: 0 held, 2 missed, 0 inconclusive\n");
    assert_null(strstr(strstr(answer.text, "\nexpected: ") + 1, "\nexpected: "));
    run_program(&answer, RUN "@/budgets.yaml -o @/later");
    assert_int_equal(answer.code, 0);
    check_answer("run --resume @/later --check", 1, "0 held, 2 missed");
    check_answer("run --resume @/later --processes 3 --check", 1, "0 held, 2 missed");
    check_answer("run --resume @/later", 0, "results: ");
}

static void json_has_every_finding(void **state)
{
    (void)state;
    write_suite("  - {where: {point: 8}, median_ms: \"<= 1e-6\"}\n  - {nonfinite: 0}\n");
    json_t *json = run_json(run_words("--check --json"), 1);
    const json_t *list = json_object_get(json, "expected");
    assert_int_equal(json_array_size(list), 3);
    const json_t *first = json_array_get(list, 0);
    assert_string_equal(json_string_value(json_object_get(first, "verdict")), "missed");
    assert_string_equal(json_string_value(json_object_get(first, "expected")),
                        "median_ms <= 1e-6");
    check_contains(json_string_value(json_object_get(first, "at")), "budgets.yaml:4:36");
    json_decref(json);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_holds_ends_with_0),
        cmocka_unit_test(what_is_missed_ends_with_1_and_a_line_each),
        cmocka_unit_test(what_is_inconclusive_fails_only_where_it_is_asked_to),
        cmocka_unit_test(without_check_nothing_is_judged),
        cmocka_unit_test(slips_are_answered_before_anything_is_measured),
        cmocka_unit_test(without_a_timer_errors_are_judged_and_times_are_not),
        cmocka_unit_test(the_last_process_judges_and_so_does_a_resumed_run),
        cmocka_unit_test(json_has_every_finding),
    };
    return end_tests(run_tests(tests));
}
