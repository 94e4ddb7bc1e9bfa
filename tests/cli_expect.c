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
    check_shell("$SB compare @/untimed @/untimed 2>&1 | grep -c incomplete", 1, "0");
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

// Fields of a test case of JUnit's file, from its name on.
static const char *case_of(const char *junit, const char *name)
{
    const char *at = strstr(junit, name);
    if (!at)
        fail_msg("no %s in %s", name, junit);
    static char part[4096];
    snprintf(part, sizeof part, "%.*s", (int)(strstr(at, "</testcase>") - at), at);
    return part;
}

static void other_programs_are_told_of_all_that_a_row_misses(void **state)
{
    (void)state;
    write_suite("  - {where: {point: 8}, median_ms: \"<= 1e-6\"}\n"
                "  - {where: {point: 8}, cpu_ms: \"<= 1e-6\"}\n"
                "  - {where: {point: 8}, ratio: \"<= 1e-6\"}\n");
    check_answer(run_words("--check --write junit=@/all.xml"), 1, "3 missed");
    char *junit = read_file("all.xml");
    const char *it = case_of(junit, "name=\"context=null,point=8\"");
    check_contains(it, "<failure message=\"missed: median_ms &lt;= 1e-6 of ");
    check_contains(it, "; cpu_ms &lt;= 1e-6 of ");
    check_contains(it, "; ratio &lt;= 1e-6 of ");
    free(junit);
}

// A time without a timer is inconclusive: behind what is missed it makes nothing better.
static void the_worst_of_several_findings_is_that_of_the_row(void **state)
{
    (void)state;
    write_suite("  - {where: {point: 8}, max_err: \"<= 1e-9\"}\n"
                "  - {where: {point: 8}, median_ms: \"<= 1e-6\"}\n");
    check_answer(run_words("--timer none --check --write junit=@/worst.xml"), 1,
                 "1 missed, 1 inconclusive");
    char *junit = read_file("worst.xml");
    const char *it = case_of(junit, "name=\"context=null,point=8\"");
    check_contains(it, "<failure message=\"missed: ");
    check_contains(it, "max_err &lt;= 1e-9 of ");
    check_contains(it, "; median_ms &lt;= 1e-6 of ");
    free(junit);
}

static void a_row_that_failed_by_itself_keeps_its_status(void **state)
{
    (void)state;
    write_suite("  - {where: {point: 8}, median_ms: \"<= 1000\"}\n");
    setenv("FAULT", "abort@prepare:2", 1);
    check_answer(run_words("--check --write junit=@/own.xml --worker "
                           "'exec " SB_FAULTY_WORKER "'"),
                 3, "1 missed");
    unsetenv("FAULT");
    char *junit = read_file("own.xml");
    const char *it = case_of(junit, "name=\"context=null,point=8\"");
    check_contains(it, "<error message=\"worker_crashed: ");
    check_contains(it, "SIGABRT");
    check_contains(it, "; median_ms &lt;= 1000 of ");
    check_contains(it, "\nmedian_ms &lt;= 1000 of "); // in the text, too
    free(junit);
}

static void a_budget_that_names_no_row_has_no_numbers(void **state)
{
    (void)state;
    write_suite("  - {where: {point: 64}, nonfinite: 0}\n");
    check_answer(run_words("--check --write junit=@/none.xml --write bencher=@/none.json "
                           "--write github-action-benchmark=@/none2.json --write "
                           "go=@/none.txt"),
                 1, "0 held, 1 missed");
    static const char *const others[] = {"none.json", "none2.json", "none.txt"};
    char *junit = read_file("none.xml");
    check_contains(junit, "<testsuite name=\"expect\" tests=\"1\" failures=\"1\"");
    const char *it = case_of(junit, "classname=\"expect\"");
    check_contains(it, "<failure message=\"missed: nonfinite = 0: it names no row (");
    assert_null(strstr(it, "ms a frame"));
    free(junit);
    for (int i = 0; i < 3; i++) {
        char *text = read_file(others[i]);
        check_contains(text, "point=8");
        assert_null(strstr(text, "no row"));
        free(text);
    }
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
        cmocka_unit_test(other_programs_are_told_of_all_that_a_row_misses),
        cmocka_unit_test(the_worst_of_several_findings_is_that_of_the_row),
        cmocka_unit_test(a_row_that_failed_by_itself_keeps_its_status),
        cmocka_unit_test(a_budget_that_names_no_row_has_no_numbers),
    };
    return end_tests(run_tests(tests));
}
