// shadebench run --write: what other programs get, and when.
#include "cli_running.h"

#define RUN "run --context null -q --sweep point=1,2 --rounds 20 --first-look 10 "

static struct running program;

static json_t *read_json(const char *name)
{
    json_error_t cause;
    char *text = read_file(name);
    json_t *json = json_loads(text, 0, &cause);
    if (!json)
        fail_msg("%s: %s", name, cause.text);
    free(text);
    return json;
}

// Entries of Google Benchmark's JSON that are samples.
static int count_samples(const char *name)
{
    json_t *json = read_json(name);
    const json_t *it;
    size_t i;
    int count = 0;
    json_array_foreach(json_object_get(json, "benchmarks"), i, it) count +=
        json_object_get(it, "repetition_index") != NULL;
    json_decref(json);
    return count;
}

static void every_format_of_the_list_can_be_written(void **state)
{
    (void)state;
    static struct answer answer;
    char line[4096] = RUN "-o @/all";
    json_t *list = run_json("list formats --json", 0);
    const json_t *it;
    size_t i;
    assert_int_equal(json_array_size(list), 8);
    json_array_foreach(list, i, it)
    {
        const char *name = json_string_value(json_object_get(it, "format"));
        const size_t length = strlen(line);
        snprintf(line + length, sizeof line - length, " --write %s=@/%s", name, name);
    }
    run_program(&answer, line);
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "median ms"); // the table is there all the same
    json_array_foreach(list, i, it)
    {
        char *text = read_file(json_string_value(json_object_get(it, "format")));
        assert_true(strlen(text) > 100);
        free(text);
    }
    json_decref(list);
    assert_int_equal(count_samples("gbench-json"), 2 * 20);
    assert_int_equal(count_samples("gbench-json-aggregates"), 0);
    char *go = read_file("go");
    check_contains(go, "\nBenchmarkContainers/context=null/point=2-1\t");
    free(go);
    char *junit = read_file("junit");
    check_contains(junit, "<testsuites name=\"shadebench run command-line\" tests=\"2\" "
                          "failures=\"0\" errors=\"0\" skipped=\"0\">");
    free(junit);
}

// The figures of a file are those of the folder.
static void samples_and_medians_are_those_of_the_results_folder(void **state)
{
    (void)state;
    struct sb_csv samples, summary;
    check_answer(RUN "-o @/same --write gbench-json=@/same.json", 0, "");
    read_csv("same/samples.csv", &samples);
    read_csv("same/summary.csv", &summary);
    json_t *json = read_json("same.json");
    const json_t *list = json_object_get(json, "benchmarks");
    int at = 0; // among the entries of the first row
    for (int line = 1; line < samples.row_count; line++) {
        if (strcmp(csv_cell(&samples, line, "variant"), "context=null,point=1") != 0)
            continue;
        const double ns = atof(csv_cell(&samples, line, "gpu_ns")),
                     batch = atof(csv_cell(&samples, line, "batch"));
        const json_t *entry = json_array_get(list, (size_t)at++);
        check_close(json_number_value(json_object_get(entry, "real_time")), ns / batch,
                    1e-6);
        check_close(json_number_value(json_object_get(entry, "iterations")), batch, 0);
    }
    assert_int_equal(at, 20);
    const json_t *median = json_array_get(list, 20 + 1);
    assert_string_equal(json_string_value(json_object_get(median, "aggregate_name")),
                        "median");
    check_close(json_number_value(json_object_get(median, "real_time")),
                1e6 * atof(csv_cell(&summary, 1, "median_ms")), 1e-3);
    json_decref(json);
    sb_csv_free(&samples);
    sb_csv_free(&summary);
}

static void a_dash_is_standard_output_instead_of_the_table(void **state)
{
    (void)state;
    static struct answer answer;
    json_t *json = run_json(RUN "-o @/dash --write bencher=-", 0);
    assert_int_equal(json_object_size(json), 2);
    json_decref(json);
    run_program(&answer, RUN "-o @/dash2 --write=markdown=-");
    assert_int_equal(strncmp(answer.text, "### shadebench run", 18), 0);
    assert_null(strstr(answer.text, "median ms"));
    check_answer(RUN "-o @/no --json --write go=-", 2,
                 "--write go=-: standard output is taken by --json");
    check_answer(RUN "-o @/no --write junit=- --write go=-", 2,
                 "--write go=-: standard output is taken by junit");
    check_shell("ls -d @/no 2>&1", 2, "No such file");
    check_shell("exec $SB " RUN "-o @/full --write go=- 2>&1 >/dev/full", 3,
                "No space left");
}

static void a_wrong_word_is_one_line_before_anything_is_measured(void **state)
{
    (void)state;
    static const struct {
        const char *word, *part;
    } wrong[] = {
        {"jnit=@/x", "unknown format \"jnit\"; did you mean \"junit\"? valid: gbench"},
        {"=@/x", "unknown format \"\""},
        {"bencher", "--write bencher: FORMAT=FILE in one word is wanted, such as "
                    "--write bencher=FILE"},
        {"bencer", "such as --write bencher=FILE"},
        {"junit=", "such as --write junit=FILE"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        static struct answer answer;
        char line[256];
        snprintf(line, sizeof line, RUN "-o @/never --write %s", wrong[i].word);
        run_program(&answer, line);
        if (answer.code != 2 || count_lines(answer.text) != 1 ||
            !strstr(answer.text, wrong[i].part))
            fail_msg("%s: %d: %s", wrong[i].word, answer.code, answer.text);
    }
    check_shell("ls -d @/never 2>&1", 2, "No such file");
    check_answer("compare --pareto @/all --write junit=@/x", 2, "unknown option");
}

static void a_file_that_cannot_be_written_loses_nothing(void **state)
{
    (void)state;
    static struct answer answer;
    if (access("/dev/full", W_OK) != 0)
        skip();
    run_program(&answer, RUN "-o @/kept --write junit=/dev/full --write go=@/kept.txt");
    assert_int_equal(answer.code, 3);
    check_contains(answer.text, "/dev/full: No space left");
    check_contains(answer.text, "median ms");
    assert_true(run_is_complete("kept/run.json"));
    char *go = read_file("kept.txt"); // the others are written
    check_contains(go, "Benchmark");
    free(go);
}

static void a_path_that_cannot_be_is_told_before_anything_is_measured(void **state)
{
    (void)state;
    static const struct {
        const char *words, *part;
    } wrong[] = {
        {"-o @/never --write go=@/no/where.txt", "where.txt: there is no folder @/no"},
        {"-o @/never --write go=@", "is a folder; give a file"},
        {"-o @/never --write go=@/neverland/x", "there is no folder @/neverland"},
        {"-o @/never --write junit=@/x --write go=no/x", "there is no folder no"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        static struct answer answer;
        char line[256], part[128];
        snprintf(line, sizeof line, RUN "%s", wrong[i].words);
        expand(part, sizeof part, wrong[i].part);
        run_program(&answer, line);
        if (answer.code != 2 || count_lines(answer.text) != 1 ||
            !strstr(answer.text, part))
            fail_msg("%s: %d: %s", line, answer.code, answer.text);
    }
    check_shell("ls -d @/never 2>&1", 2, "No such file");
    // The results folder is made by the run.
    check_answer(RUN "-o @/made/ --write go=@/made/go.txt --write go=/dev/null", 0, "");
    free(read_file("made/go.txt"));
}

// Whoever reads the table may leave before it is there.
static void a_reader_that_leaves_costs_no_file(void **state)
{
    (void)state;
    write_file("page", "before\n");
    write_file("checked.yaml", "suite: checked\nsweep: {point: [1, 2]}\n"
                               "expect: [{nonfinite: 0}]\n");
    check_shell("{ GITHUB_STEP_SUMMARY=@/page $SB run @/checked.yaml --context null -q "
                "--rounds 20 --first-look 10 --check -o @/left --write go=@/left.txt "
                "2>@/said; echo $? >@/code; } | true; cat @/code @/said",
                0, "3\nshadebench: stdout cannot be written");
    char *go = read_file("left.txt"), *page = read_file("page");
    check_contains(go, "BenchmarkContainers/");
    check_contains(page, "before\n### shadebench run checked");
    free(go);
    free(page);
}

static void a_complete_folder_is_written_without_measuring(void **state)
{
    (void)state;
    check_answer(RUN "-o @/done --write gbench-json=@/first.json", 0, "median ms");
    check_answer("run --resume @/done --write gbench-json=@/again.json --write "
                 "markdown=-",
                 0, "2 passed");
    char *first = read_file("first.json"), *again = read_file("again.json");
    assert_string_equal(first, again);
    free(first);
    free(again);
    // What was asked for at first is not asked for now.
    check_shell("rm @/first.json && exec $SB run --resume @/done -q", 0, "median ms");
    check_shell("ls @/first.json 2>&1", 2, "No such file");
}

#define GATE "gate --context null -q --sweep point=1,2 --base @/base "

// Of most changes, which touch no shader: trackers have a point of them all the same.
static void a_gate_of_equal_shaders_is_a_ratio_of_1(void **state)
{
    (void)state;
    check_shell("cp -r '" SB_SOURCE_DIR "/shaders' @/base", 0, "");
    json_t *list = run_json(GATE "-o @/equal --write github-action-benchmark=-", 0);
    assert_int_equal(json_array_size(list), 2);
    for (size_t i = 0; i < 2; i++) {
        const json_t *value = json_object_get(json_array_get(list, i), "value");
        check_close(json_number_value(value), 1, 0);
    }
    json_decref(list);
}

static void a_gate_that_counts_has_ratios_and_counts(void **state)
{
    (void)state;
    check_answer(GATE "--keep-equal --metric instructions -o @/counts --write "
                      "github-action-benchmark=@/counts.json --write "
                      "bencher=@/counts-b.json --write go=@/counts.txt",
                 0, "2 pass");
    json_t *list = read_json("counts.json"), *bencher = read_json("counts-b.json");
    assert_int_equal(json_array_size(list), 2);
    assert_int_equal(json_object_size(bencher), 4);
    json_decref(list);
    json_decref(bencher);
    struct sb_csv csv;
    char line[128], *go = read_file("counts.txt");
    read_csv("counts/gate.csv", &csv);
    snprintf(line, sizeof line, "/point=1/side=head-1\t1\t%.0f Ir/op\n",
             atof(csv_cell(&csv, 1, "head_instructions")));
    check_contains(go, line);
    sb_csv_free(&csv);
    free(go);
}

static void the_last_of_several_processes_writes_the_samples_of_all(void **state)
{
    (void)state;
    check_answer(RUN "--processes 3 -o @/three --write gbench-json=@/three.json "
                     "--write junit=@/three.xml",
                 0, "ci95_between_processes");
    assert_int_equal(count_samples("three.json"), 3 * 2 * 20);
    char *junit = read_file("three.xml");
    check_contains(junit, "<property name=\"processes\" value=\"3\"/>");
    free(junit);
}

static void an_interrupted_run_is_written_too(void **state)
{
    (void)state;
    start_program(&program, "run --context null --sweep point=1,2 --rounds 1000000 "
                            "--half-width 0.0001 --budget 100000 -o @/stopped --write "
                            "gbench-json=@/stopped.json");
    wait_until_said(&program, "round 100");
    kill(program.pid, SIGINT);
    assert_int_equal(finish(&program), 130);
    assert_true(count_samples("stopped.json") >= 2 * 100);

    start_program(&program,
                  "run --context null --sweep point=1,2 --budget 100000 -o @/early "
                  "--write junit=@/early.xml");
    wait_until_said(&program, "checking");
    kill(program.pid, SIGINT);
    assert_int_equal(finish(&program), 130);
    char *junit = read_file("early.xml");
    check_contains(junit, "<skipped message=\"not_measured");
    free(junit);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_of_the_list_can_be_written),
        cmocka_unit_test(samples_and_medians_are_those_of_the_results_folder),
        cmocka_unit_test(a_dash_is_standard_output_instead_of_the_table),
        cmocka_unit_test(a_wrong_word_is_one_line_before_anything_is_measured),
        cmocka_unit_test(a_file_that_cannot_be_written_loses_nothing),
        cmocka_unit_test(a_path_that_cannot_be_is_told_before_anything_is_measured),
        cmocka_unit_test(a_reader_that_leaves_costs_no_file),
        cmocka_unit_test(a_complete_folder_is_written_without_measuring),
        cmocka_unit_test(a_gate_of_equal_shaders_is_a_ratio_of_1),
        cmocka_unit_test(a_gate_that_counts_has_ratios_and_counts),
        cmocka_unit_test(the_last_of_several_processes_writes_the_samples_of_all),
        cmocka_unit_test(an_interrupted_run_is_written_too),
    };
    return end_tests(run_tests(tests));
}
