// shadebench gate as a user or a CI job has it: words, exit codes, what it prints and writes.
#include "cli_fixture.h"

// Two equal sides with other names: everything passes, as the null runner draws both alike.
#define NULL_GATE "gate --context null --scene containers -q "
#define EQUAL     NULL_GATE "--sweep point=1,2 --keep-equal --base $BASE "
// Base has a loop that is cheaper on the null runner.
#define SLOWER NULL_GATE "--set point=64 --base-set loop=unrolled "
// Nobody can be shown to be no slower at all.
#define UNSURE EQUAL "--tolerance 0% "

static void usage_errors_are_one_line_and_exit_code_2(void **state)
{
    (void)state;
    static const struct {
        const char *words, *part;
    } wrong[] = {
        {"", "gate holds head against base: --base SHADERS (a folder or a git revision)"},
        {"ci mix --selftest", "gate takes one suite; \"mix\" is one too many"},
        {"nosuch --selftest", "unknown suite \"nosuch\""},
        {"--selftest --base $BASE", "--selftest holds base against itself"},
        {"--selftest --base-set point=1", "--selftest holds base against itself"},
        {"--selftest --head-env A=1", "--selftest holds base against itself"},
        {"--base @/nowhere", "@/nowhere: "},
        {"--base $BASE --head @/nowhere", "@/nowhere: "},
        {"--base $BASE --shaders @/nowhere", "--shaders @/nowhere: there is no such"},
        {"--base", "--base wants a value"},
        {"--base-set point", "AXIS=VALUE in one word is wanted"},
        {"--base-set poimt=1", "unknown axis \"poimt\""},
        {"--base-set point=1", "base and head have another point, so they draw two"},
        {"--base-set threads=1 --head-set threads=2", "another threads"},
        {"--base-set driver=softpipe", "another driver"},
        {"--head-set api=gles", "another api"},
        {"--base-env LP_NUM_THREADS", "LP_NUM_THREADS=1"},
        {"--base-env A=1 --in-process", "--in-process has one environment"},
        {"--selftest --in-process --worker x", "--in-process has no worker"},
        {"--selftest --worker-limit 0", "seconds over 0 are wanted"},
        {"--selftest --tolerance 2", "a share is wanted, as 2% or 0.02"},
        {"--selftest --tolerance -1%", "a share is wanted"},
        {"--selftest --tolerance 100%", "below 100%"},
        {"--selftest --metric time", "unknown metric \"time\""},
        {"--selftest --metric gpuu", "did you mean \"gpu\"?"},
        {"--selftest --timer nosuch", "unknown timer \"nosuch\""},
        {"--selftest --write junit", "FORMAT=FILE in one word is wanted"},
        {"--selftest --json --write go=-", "standard output is taken by --json"},
        {"--selftest --cases zero-normel",
         "--cases: unknown case or family \"zero-normel\"; did you mean "
         "\"zero-normal\"?"},
        {"--selftest --cases all,light-order", "unknown case or family \"all\""},
        {"--selftest --rounds 20", "--rounds 20 says nothing to a gate"},
        {"--selftest --half-width=0.1", "says nothing to a gate"},
        {"--selftest --processes 3", "says nothing to a gate"},
        {"--selftest --budget 0", "budget"},
        {"--selftest --check", "unknown option \"--check\""},
        {"--selftest --resume x", "unknown option \"--resume\""},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        static struct answer answer;
        char line[512], part[256];
        snprintf(line, sizeof line, "gate --context null -q -o @/wrong %s",
                 wrong[i].words);
        expand(part, sizeof part, wrong[i].part);
        run_program(&answer, line);
        if (answer.code != 2 || !strstr(answer.text, part) ||
            count_lines(answer.text) != 1)
            fail_msg("%s: exit code %d: %s", line, answer.code, answer.text);
    }
    check_shell("test ! -e @/wrong/gate.json", 0, ""); // nothing was begun
}

static void equal_programs_pass(void **state)
{
    (void)state;
    static struct answer answer;
    run_program(&answer, EQUAL "-o @/equal");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "gate command-line: base ");
    check_contains(answer.text, "metric: gpu (scripted)");
    check_contains(answer.text, "tolerance 2 %, alpha 5 % over 2 timed variants");
    check_contains(answer.text, "2 pass");
    check_contains(answer.text, "equal/gate.csv");
    check_answer(NULL_GATE "--sweep point=1,2 --base $BASE -o @/skipped", 0,
                 "2 skipped\nskipped: the final sources of both sides are equal");
    check_answer(NULL_GATE "--base $BASE -o @/skipped2", 0, "rule: no variant was timed");
}

// The null runner draws black, which both sides pass or fail alike.
static void hard_cases_that_both_sides_hold_are_none_lost(void **state)
{
    (void)state;
    struct sb_csv csv;
    check_answer(NULL_GATE "--base $BASE --cases light-order,dist-overflow16 -o @/cases",
                 0, "hard cases: 0 that base passes and head does not");
    read_csv("cases/cases-head/cases.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 2 + 4); // the robust cells alone
    sb_csv_free(&csv);
    json_t *json =
        run_json(NULL_GATE "--base $BASE --cases relations -o @/cases2 --json", 0);
    assert_int_equal(json_integer_value(json_object_get(json, "cases_lost")), 0);
    json_decref(json);
}

static void what_is_slower_is_a_regression_and_exit_code_1(void **state)
{
    (void)state;
    struct sb_csv csv;
    check_answer(SLOWER "-o @/slower", 1, "1 regression");
    read_csv("slower/gate.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "verdict"), "regression");
    assert_true(atof(csv_cell(&csv, 1, "confirm_p")) < 0.05);
    sb_csv_free(&csv);
    check_answer(SLOWER "-o @/slower2", 1,
                 "regression: containers context=null,point=64: ratio ");
    // Turned round it is the other way.
    check_answer(NULL_GATE "--set point=64 --head-set loop=unrolled -o @/faster", 0,
                 "1 improved");
}

static void inconclusive_is_an_exit_code_where_asked_for(void **state)
{
    (void)state;
    check_answer(UNSURE "-o @/unsure", 0, "2 inconclusive");
    check_answer(UNSURE "-o @/unsure2 --fail-on-inconclusive", 4, "2 inconclusive");
    check_answer(EQUAL "-o @/sure --fail-on-inconclusive", 0, "2 pass");
    // A regression weighs more.
    check_answer(SLOWER "-o @/both --fail-on-inconclusive", 1, "1 regression");
}

// git bisect run: 0 good, 1 bad, 125 skip, 128 and more stop.
static void bisect_has_the_exit_codes_of_git(void **state)
{
    (void)state;
    check_answer(EQUAL "-o @/b0 --bisect", 0, "2 pass");
    check_answer(SLOWER "-o @/b1 --bisect", 1, "1 regression");
    check_answer(UNSURE "-o @/b2 --bisect --fail-on-inconclusive", 125, "2 inconclusive");
    check_answer(UNSURE "-o @/b3 --bisect", 125, "2 inconclusive");
    // Head does not compile: that commit cannot be tested.
    check_answer(NULL_GATE "--base $BASE --head @/empty -o @/b4 --bisect", 125,
                 "1 invalid");
    check_answer(NULL_GATE "--base $BASE --head @/empty -o @/b5", 2, "1 invalid");
    // Wrong at each commit: git must not call them all bad, nor all good.
    check_answer(NULL_GATE "--base @/empty -o @/b6 --bisect", 128,
                 "base cannot be judged at all");
    check_answer(EQUAL "-o @/b0 --bisect", 128, "pairs.csv exists");
    check_answer("gate --bisect --context null", 128, "gate holds head against base");
    check_answer("gate --bisect --base @/nowhere --context null", 128, "/nowhere: ");
    check_answer("gate --context null --bisect --selftest", 128, "--bisect wants");
    check_answer("gate --basis x --bisect", 128, "did you mean \"--base\"?");
    check_answer("gaet --base x --bisect", 128, "did you mean \"gate\"?");
}

static void json_has_every_row_and_the_counts(void **state)
{
    (void)state;
    json_t *json = run_json(SLOWER "-o @/json --json", 1);
    const json_t *rows = json_object_get(json, "rows"), *row = json_array_get(rows, 0);
    const json_t *verdicts = json_object_get(json, "verdicts");
    assert_int_equal(json_array_size(rows), 1);
    assert_string_equal(json_string_value(json_object_get(row, "verdict")), "regression");
    assert_string_equal(json_string_value(json_object_get(row, "status")), "ok");
    assert_string_equal(json_string_value(json_object_get(row, "picture")), "equal");
    assert_true(json_number_value(json_object_get(row, "ratio")) > 1.5);
    assert_int_equal(json_integer_value(json_object_get(verdicts, "regression")), 1);
    assert_int_equal(json_integer_value(json_object_get(verdicts, "pass")), 0);
    assert_int_equal(json_object_size(verdicts), 9);
    check_close(json_number_value(json_object_get(json, "tolerance")), 0.02, 1e-12);
    assert_true(json_is_false(json_object_get(json, "interrupted")));
    assert_string_equal(json_string_value(json_object_get(json, "metric")), "gpu");
    assert_true(json_number_value(json_object_get(json, "mde")) > 0.02);
    json_decref(json);
    json = run_json(NULL_GATE "--selftest -o @/json2 --json --tolerance 5%", 0);
    assert_true(json_number_value(json_object_get(json, "bias")) < 0.025);
    json_decref(json);
}

static void a_selftest_says_whether_the_tolerance_can_be_used(void **state)
{
    (void)state;
    check_answer(NULL_GATE "--selftest --tolerance 5% -o @/self", 0,
                 "a tolerance of 5 % is at least twice that: it can be used here");
    check_answer(NULL_GATE "--selftest --tolerance 0% -o @/self2", 3,
                 "under twice that: refused; --tolerance ");
    // For other programs it is no success, either.
    check_answer(NULL_GATE "--selftest --tolerance 0% -o @/self3 --write junit=-", 3,
                 "errors=\"1\"");
}

// --- for other programs ----------------------------------------------------------------------

#define WRITTEN(format) "--write " format "=@/out-" format " "

static void every_format_tells_of_a_gate(void **state)
{
    (void)state;
    static const struct {
        const char *name, *part[3];
    } files[] = {
        {"junit",
         {"tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\"",
          "<failure message=\"regression", "in a fresh process "}},
        {"gbench-json",
         {"\"base/containers/context=null,point=64\"",
          "\"head/containers/context=null,point=64\"", "\"median\""}},
        {"markdown",
         {"### shadebench gate command-line", "| variant | base | head | ratio",
          "**1 failed**, 0 passed"}},
        {"github-action-benchmark", {"\"unit\": \"ratio\"", "point=64", "regression"}},
        {"bencher", {"\"head/containers/context=null,point=64\"", "\"ratio\"", "lower"}},
        {"go", {"/side=base-1\t", "/side=head-1\t", " ns/op"}},
    };
    static struct answer answer;
    run_program(&answer, SLOWER WRITTEN("junit") WRITTEN("gbench-json")
                             WRITTEN("markdown") WRITTEN("github-action-benchmark")
                                 WRITTEN("bencher") WRITTEN("go") "-o @/outputs");
    assert_int_equal(answer.code, 1);
    check_contains(answer.text, "1 regression"); // the table is there all the same
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char name[64];
        snprintf(name, sizeof name, "out-%s", files[i].name);
        char *text = read_file(name);
        for (int p = 0; p < 3; p++)
            check_contains(text, files[i].part[p]);
        free(text);
    }
}

static void the_page_of_a_github_job_gets_the_table(void **state)
{
    (void)state;
    check_shell("echo before >@/page; GITHUB_STEP_SUMMARY=@/page exec $SB " SLOWER
                "-o @/page-out 2>&1",
                1, "1 regression");
    char *page = read_file("page");
    assert_int_equal(strncmp(page, "before\n", 7), 0);
    check_contains(page, "| containers/context=null,point=64 |");
    check_contains(page, "regression");
    free(page);
    check_shell("GITHUB_STEP_SUMMARY=@/no/page exec $SB " EQUAL "-o @/page2 2>&1", 3,
                "$GITHUB_STEP_SUMMARY: ");
}

// What base alone gets wrong is no error of head's, in any of them.
static void a_broken_base_is_skipped_for_other_programs(void **state)
{
    (void)state;
    check_answer(NULL_GATE "--base @/empty -o @/broken --write junit=@/broken.xml", 0,
                 "base: bad_input");
    char *junit = read_file("broken.xml");
    check_contains(junit, "failures=\"0\" errors=\"0\" skipped=\"1\"");
    free(junit);
    check_answer(NULL_GATE "--base @/empty -o @/broken2 --fail-on-inconclusive", 4,
                 "1 invalid");
}

// --- git -------------------------------------------------------------------------------------

static const char repository[] =
    "set -e; mkdir -p @/repo/deep && cp -r \"$BASE/.\" @/repo/deep/shaders\n"
    "cd @/repo && git init -q . && git config user.email a@b.c && git config user.name "
    "n\n"
    "git add -A && git commit -qm one && git tag old\n"
    "for f in deep/shaders/model/*.glsl; do echo '// a comment' >>$f; done\n"
    "git commit -qam two && git rm -rqf deep && echo x >x && git add x\n"
    "git commit -qm gone && git tag gone && git reset -q --hard HEAD~1\n";

static void a_git_revision_gives_the_shaders_as_they_were(void **state)
{
    (void)state;
    static struct answer answer;
    run_shell(&answer, "command -v git && command -v tar");
    if (answer.code != 0) {
        print_message("skipped: no git here\n");
        skip();
    }
    check_shell(repository, 0, "");
    check_answer(NULL_GATE "--shaders @/repo/deep/shaders --base HEAD~1 -o @/git", 0,
                 "gate command-line: base HEAD~1, head ");
    check_shell("diff -r \"$BASE\" @/git/base-shaders 2>&1", 0, "");
    struct sb_csv csv;
    read_csv("git/gate.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "verdict"), "pass"); // timed: the texts differ
    sb_csv_free(&csv);
    check_shell("ls @/git/*.tar 2>&1", 2, "No such file");
    // The same commit on both sides, once from the working tree.
    check_answer(NULL_GATE "--shaders @/repo/deep/shaders --base HEAD -o @/git2", 0,
                 "1 skipped");
    check_answer(NULL_GATE
                 "--shaders @/repo/deep/shaders --base old --head HEAD -o @/git3",
                 0, "base old, head HEAD");
    // From another folder, by a path that is not whole, into a folder that is not whole.
    check_shell("cd @/repo/deep && exec $SB " NULL_GATE
                "--shaders shaders --base old -o ../here 2>&1",
                0, "1 pass");
    check_answer(NULL_GATE "--shaders @/repo/deep/shaders --base nosuch -o @/git4", 2,
                 "nosuch: neither a folder nor a git revision of the repository that ");
    check_answer(NULL_GATE "--shaders @/repo/deep/shaders --base gone -o @/git5", 2,
                 "git archive gives no such folder");
    check_answer(NULL_GATE "--shaders @/repo/deep/shaders --base=--all -o @/git6", 2,
                 "neither a folder nor a git revision");
    check_shell("cp -r \"$BASE\" @/plain; GIT_CEILING_DIRECTORIES=@ exec $SB " NULL_GATE
                "--shaders @/plain --base HEAD -o @/git7 2>&1",
                2,
                "lies in no git repository of which it could be a revision; git says: ");
}

int main(void)
{
    begin_tests();
    unsetenv("GITHUB_STEP_SUMMARY");
    setenv("BASE", SB_SOURCE_DIR "/shaders", 1);
    setenv("GIT_CONFIG_GLOBAL", "/dev/null", 1);
    static struct answer answer;
    run_shell(&answer, "mkdir @/empty");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(usage_errors_are_one_line_and_exit_code_2),
        cmocka_unit_test(equal_programs_pass),
        cmocka_unit_test(hard_cases_that_both_sides_hold_are_none_lost),
        cmocka_unit_test(what_is_slower_is_a_regression_and_exit_code_1),
        cmocka_unit_test(inconclusive_is_an_exit_code_where_asked_for),
        cmocka_unit_test(bisect_has_the_exit_codes_of_git),
        cmocka_unit_test(json_has_every_row_and_the_counts),
        cmocka_unit_test(a_selftest_says_whether_the_tolerance_can_be_used),
        cmocka_unit_test(every_format_tells_of_a_gate),
        cmocka_unit_test(the_page_of_a_github_job_gets_the_table),
        cmocka_unit_test(a_broken_base_is_skipped_for_other_programs),
        cmocka_unit_test(a_git_revision_gives_the_shaders_as_they_were),
    };
    return end_tests(run_tests(tests));
}
