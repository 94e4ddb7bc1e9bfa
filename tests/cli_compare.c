// shadebench compare, on results folders that the tests make.
#include "cli_rows.h"

static void set_error(struct sb_row *row, double error)
{
    row->max_err = error;
    row->p999_err = error / 2;
    row->flip_mean = error / 10;
    row->nonfinite = 0;
}

// form: robust is slow and right, naive fast and wrong; normalise=off is slow and wrong.
static void make_run(void)
{
    static struct answer answer;
    if (rows.count)
        return;
    run_program(&answer, RUN "-o @/run --set point=2 --sweep form=robust,naive "
                             "--sweep normalise=off");
    if (answer.code != 0)
        fail_msg("%s", answer.text);
    read_rows("run/summary.csv");
    assert_int_equal(rows.count, 3);
    set_time(&rows.row[0], 2);
    set_error(&rows.row[0], 1e-6);
    set_time(&rows.row[1], 1);
    set_error(&rows.row[1], 0.02);
    set_time(&rows.row[2], 3);
    set_error(&rows.row[2], 0.01);
    write_rows("run/summary.csv");
}

static const char line_of_dominated[] =
    "dominated by form=robust (1.50 times slower, 10000 times the error)";

static void pareto_sorts_by_time_and_names_what_dominates(void **state)
{
    (void)state;
    static struct answer answer;
    make_run();
    run_program(&answer, "compare --pareto @/run");
    assert_int_equal(answer.code, 0);
    const char *naive = strstr(answer.text, "on         naive"),
               *robust = strstr(answer.text, "on         robust"),
               *last = strstr(answer.text, line_of_dominated);
    assert_true(naive && naive < robust && robust < last);
    check_contains(naive, "  1.0 %");
    check_contains(naive, "0.02      5.1   0.01  0.002");
    check_contains(naive, "front\n");
    check_answer("compare --pareto @/run/summary.csv", 0, line_of_dominated);
}

static void pareto_json_has_every_column_of_every_row(void **state)
{
    (void)state;
    make_run();
    json_t *json = run_json("compare --pareto @/run --json", 0);
    const json_t *groups = json_object_get(json, "groups");
    assert_int_equal(json_array_size(groups), 1);
    assert_int_equal(json_array_size(json_object_get(json, "not_ranked")), 0);
    const json_t *list = json_object_get(json_array_get(groups, 0), "rows");
    assert_int_equal(json_array_size(list), 3);
    const json_t *last = json_array_get(list, 2);
    assert_int_equal(json_object_size(last), sb_summary_column_count - 1 + axes.count);
    assert_string_equal(json_string_value(json_object_get(last, "front")), "dominated");
    assert_string_equal(json_string_value(json_object_get(last, "dominated_by")),
                        rows.row[0].variant);
    check_close(json_number_value(json_object_get(last, "dominated_time")), 1.5, 1e-12);
    check_close(json_number_value(json_object_get(last, "dominated_err")), 1e4, 1e-6);
    json_decref(json);
}

// Another width is another question; what has no error is listed apart.
static void groups_are_told_apart_by_what_differs_between_them(void **state)
{
    (void)state;
    static struct answer answer;
    make_run();
    rows.variant[2].value[SB_AXIS_WIDTH] = 64;
    rows.row[1].max_err = NAN;
    write_rows("groups.csv");
    run_program(&answer, "compare --pareto @/groups.csv");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "\ncontainers width=256\n");
    check_contains(answer.text, "\ncontainers width=64\n");
    assert_null(strstr(answer.text, "dominated"));
    check_contains(strstr(answer.text, "\nnot ranked: "), "\nbase ");
    read_rows("run/summary.csv");
}

// A folder that lacks nothing is not measured again: its table is printed.
static void the_table_of_run_shows_errors_and_the_front_where_there_are_any(void **state)
{
    (void)state;
    static struct answer answer;
    make_run();
    rows.row[0].front = rows.row[1].front = "front";
    rows.row[2].front = "dominated";
    rows.row[2].dominated_by = rows.row[0].variant;
    rows.row[2].dominated_time = 1.5;
    rows.row[2].dominated_err = 1e4;
    write_rows("run/summary.csv");
    run_program(&answer, "run --resume @/run");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "ratio  max err  p99.9   FLIP  front\n");
    check_contains(answer.text, " 1e-06  5e-07  1e-07  front\n");
    check_contains(answer.text, line_of_dominated);

    run_program(&answer, RUN "-o @/plain --sweep point=1,2");
    assert_null(strstr(answer.text, "max err"));
    assert_null(strstr(answer.text, "front"));
}

static void terms_prices_the_suite_of_that_name(void **state)
{
    (void)state;
    static struct answer answer;
    run_program(&answer, RUN "terms -o @/terms");
    if (answer.code != 0)
        fail_msg("%s", answer.text);
    read_rows("terms/summary.csv");
    assert_int_equal(rows.count, 44); // 22 of each of two scenes
    for (int i = 0; i < rows.count; i++) {
        const bool vector = strstr(rows.row[i].variant, "p_vector=mediump") != NULL;
        set_time(&rows.row[i], 1 + i / 100.0);
        rows.row[i].ratio = 1;
        rows.row[i].ratio_lo = 0.99;
        rows.row[i].ratio_hi = 1.01;
        set_error(&rows.row[i], vector ? 0.05 : 2e-4);
    }
    write_rows("terms/summary.csv");
    run_program(&answer, "compare --terms @/terms");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "\nall highp: 1.000 ms, max error 0.0002 = 0.051/255");
    check_contains(answer.text, "\nall mediump: 1.010 ms");
    check_contains(answer.text, "\np_vector        1.00 [0.99, 1.01] ");
    check_contains(strstr(answer.text, "\np_vector "), "breaks\n");
    check_contains(strstr(answer.text, "\np_sampler "), "free\n");

    json_t *json = run_json("compare --terms @/terms --json", 0);
    const json_t *group = json_array_get(json_object_get(json, "groups"), 0), *price;
    const json_t *list = json_object_get(group, "terms");
    size_t i;
    assert_string_equal(json_string_value(json_object_get(group, "low")),
                        rows.row[1].variant);
    assert_int_equal(json_array_size(list), 10);
    json_array_foreach(list, i, price)
    {
        const char *term = json_string_value(json_object_get(price, "term"));
        const json_t *raised = json_object_get(price, "raised");
        check_contains(answer.text, term);
        check_close(json_number_value(json_object_get(raised, "time")),
                    (1.12 + (double)i / 100) / 1.01, 1e-9);
        assert_true(json_is_false(json_object_get(raised, "paired")));
        assert_true(
            json_is_true(json_object_get(json_object_get(price, "lowered"), "paired")));
    }
    json_decref(json);
    check_answer("compare --terms @/run", 2, "no row has one term lowered");
}

static const char own_suite[] = "suite: own\n"
                                "axes:\n"
                                "  - {name: knob, kind: quality, define: KNOB, min: 0, "
                                "max: 9, init: 0, help: mine}\n"
                                "sweep: {knob: [1, 2]}\n";

// Its kind stands in the suite's copy; without that nobody knows whether it may be ranked.
static void axes_of_a_suite_are_read_from_its_copy(void **state)
{
    (void)state;
    static struct answer answer;
    write_file("own.yaml", own_suite);
    run_program(&answer, RUN "@/own.yaml -o @/own");
    if (answer.code != 0)
        fail_msg("%s", answer.text);
    check_answer("compare --pareto @/own", 0, "knob");
    check_answer("compare --pareto @/own/summary.csv", 0, "knob");
    check_shell("cp @/own/summary.csv @/alone.csv", 0, "");
    check_answer("compare --pareto @/alone.csv", 2, "no axis is called \"knob\"");
    write_file("own/suite.yaml", "suite: [");
    check_answer("compare --pareto @/own", 2, "only built-in axes are known");
}

// --- two runs -------------------------------------------------------------------------------

// B has a row that is slower, one without a time, one that A has not, and lacks one.
static void make_two_runs(void)
{
    static struct answer answer;
    static bool made;
    if (made)
        return;
    run_program(&answer, RUN "-o @/a --sweep point=1,2,3,4");
    assert_int_equal(answer.code, 0);
    run_program(&answer, RUN "-o @/b --sweep point=1,2,3,5");
    assert_int_equal(answer.code, 0);
    read_rows("a/summary.csv");
    for (int i = 0; i < 4; i++) {
        set_time(&rows.row[i], 1);
        set_error(&rows.row[i], .01);
    }
    write_rows("a/summary.csv");
    read_rows("b/summary.csv");
    set_time(&rows.row[0], 1);
    rows.row[0].ci_lo_ms = .995;
    rows.row[0].ci_hi_ms = 1.005;
    set_time(&rows.row[1], 1.5);
    rows.row[1].source_hash = "0";
    rows.row[2].status = "dead_light";
    set_error(&rows.row[2], .02);
    write_rows("b/summary.csv");
    made = true;
}

static void two_runs_are_told_apart_row_by_row(void **state)
{
    (void)state;
    static struct answer answer;
    make_two_runs();
    run_program(&answer, "compare @/a @/b");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text,
                   "\n    1  1.000  1.000  1.000  0.989 … 1.011  unchanged  same ");
    check_contains(answer.text,
                   "\n    2  1.000  1.500  1.500  1.479 … 1.521  hurt       changed ");
    check_contains(strstr(answer.text, "\n    3 "), "lost       same ");
    check_contains(strstr(answer.text, "\n    3 "),
                   " 0.01       0.02  worse  ok > dead_light\n");
    check_contains(strstr(answer.text, "\n    4 "), "lost ");
    check_contains(strstr(answer.text, "\n    5 "), "gained ");
    check_contains(answer.text,
                   "\n0 helped, 1 hurt, 1 unchanged, 0 unclear, 0 untimed, 2 "
                   "lost, 1 gained, 0 refused\n");
    check_answer("compare @/a/summary.csv @/b/summary.csv --tolerance 60%", 0,
                 "0 hurt, 2 unchanged");
    assert_null(strstr(answer.text, "have the same GLSL"));
    check_answer("compare @/a @/b --tolerance 40%", 0, "1 hurt, 1 unchanged");
    check_answer("compare @/b @/a --tolerance 0.02", 0, "1 helped, 0 hurt");
}

// What is said of one process a side must not be read as a verdict on the code.
static void one_process_a_side_is_said_to_be_no_gate(void **state)
{
    (void)state;
    static struct answer answer;
    make_two_runs();
    run_program(&answer, "compare @/a @/b -q");
    check_contains(answer.text, "this is no gate: that is `shadebench gate`");
    assert_null(strstr(answer.text, "Student's t"));
    read_rows("a/summary.csv");
    for (int i = 0; i < rows.count; i++) {
        rows.row[i].processes = 3;
        rows.row[i].ci_kind = "ci95_between_processes";
    }
    write_rows("three.csv");
    run_program(&answer, "compare @/three.csv @/three.csv");
    assert_int_equal(answer.code, 0);
    assert_null(strstr(answer.text, "no gate"));
    check_contains(answer.text, "Student's t over their medians");
    check_contains(answer.text, "no run.json: its machine is not known");
    json_t *json = run_json("compare @/three.csv @/three.csv --json", 0);
    const json_t *pair = json_array_get(json_object_get(json, "rows"), 0);
    assert_string_equal(json_string_value(json_object_get(pair, "ci_kind")),
                        "ci95_between_processes");
    json_decref(json);
}

// The same text twice: what differs is not the shader.
static void rows_that_moved_without_a_change_are_counted(void **state)
{
    (void)state;
    make_two_runs();
    read_rows("a/summary.csv");
    set_time(&rows.row[3], 2);
    write_rows("moved.csv");
    check_answer("compare @/a @/moved.csv", 0,
                 "\n1 of those helped or hurt have the same GLSL in both runs");
}

static void check_ends_with_1_where_something_became_worse(void **state)
{
    (void)state;
    make_two_runs();
    check_answer("compare @/a @/b --check", 1, "1 hurt");
    check_answer("compare @/a @/b --check --tolerance 60%", 1, "0 hurt"); // dead_light
    check_answer("compare @/b @/a --check", 1, "1 helped"); // point=5 is gone
    check_answer("compare @/a @/a --check", 0, "4 unchanged");
}

// One shader of two is broken between the runs: what it had decided, the version of GLSL and the
// context, stands in its row all the same, and it compares.
static void check_ends_with_1_where_a_shader_is_broken(void **state)
{
    (void)state;
    static struct answer answer;
    struct sb_csv csv;
    const char *words = "run --context null -q --rounds 20 --sweep model=phong,blinn "
                        "--set point=1 --shaders @/shaders ";
    char line[512];
    check_shell("cp -r " SB_SOURCE_DIR "/shaders @/shaders", 0, "");
    snprintf(line, sizeof line, "%s -o @/whole", words);
    run_program(&answer, line);
    assert_int_equal(answer.code, 0);
    check_shell("echo '#include \"nowhere.glsl\"' >@/shaders/model/blinn.glsl", 0, "");
    snprintf(line, sizeof line, "%s -o @/broken", words);
    check_answer(line, 2, "nowhere.glsl");
    read_csv("broken/summary.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "status"), "ok");
    assert_string_equal(csv_cell(&csv, 2, "status"), "bad_input");
    assert_string_equal(csv_cell(&csv, 2, "glsl"), csv_cell(&csv, 1, "glsl"));
    assert_string_equal(csv_cell(&csv, 2, "storage"), csv_cell(&csv, 1, "storage"));
    sb_csv_free(&csv);
    check_answer("compare @/whole @/broken --check --tolerance 60%", 1, " 1 lost, ");
    check_answer("compare @/whole @/broken --check --tolerance 60%", 1, " 0 refused\n");
    check_answer("compare @/broken @/whole --check --tolerance 60%", 0, " 1 gained, ");
}

static void two_runs_as_json_have_every_row_and_count(void **state)
{
    (void)state;
    make_two_runs();
    json_t *json = run_json("compare @/a @/b --check --json", 1);
    const json_t *list = json_object_get(json, "rows"), *pair = json_array_get(list, 1);
    assert_int_equal(json_array_size(list), 5);
    check_close(json_number_value(json_object_get(json, "tolerance")), .02, 0);
    check_close(json_number_value(json_object_get(json, "worse")), 3, 0);
    assert_int_equal(
        json_integer_value(json_object_get(json_object_get(json, "counts"), "lost")), 2);
    check_close(json_number_value(json_object_get(pair, "ratio")), 1.5, 1e-12);
    assert_string_equal(json_string_value(json_object_get(pair, "verdict")), "hurt");
    assert_string_equal(json_string_value(json_object_get(pair, "source")), "changed");
    assert_string_equal(
        json_string_value(json_object_get(json_object_get(pair, "b"), "source_hash")),
        "0");
    assert_true(json_is_null(json_object_get(json_array_get(list, 4), "a")));
    assert_true(json_is_null(json_object_get(json_array_get(list, 3), "ratio")));
    json_decref(json);
}

static void runs_of_other_conditions_are_refused_with_the_reason(void **state)
{
    (void)state;
    static struct answer answer;
    make_two_runs();
    run_program(&answer, RUN "-o @/small --set width=64 --sweep point=1,2,3,4");
    assert_int_equal(answer.code, 0);
    check_answer("compare @/a @/small", 2,
                 "nothing to compare: 4 rows of other conditions, the first, ");
    check_answer("compare @/a @/small", 2, ": width 256 | 64");
    check_answer("compare @/a @/small --force", 0, " (forced)");
    check_answer("compare @/a @/small --force", 0, " and 3 more: width 256 | 64");
    check_answer("compare @/a @/nowhere", 2, "there is no such folder or file");
    // Threads that the driver was told by the environment stand in run.json alone.
    run_shell(&answer,
              "cp -r @/a @/told && sed -i 's/\"environment\": {/&\"LP_NUM_THREADS\":"
              " \"3\",/' @/told/run.json");
    assert_int_equal(answer.code, 0);
    check_answer("compare @/told @/a", 2, ": LP_NUM_THREADS 3 | none");
    // As do the machines that its processes were on.
    run_shell(
        &answer,
        "cp -r @/b @/moved && $SB run --resume @/moved -q --processes 2 >/dev/null && "
        "sed -i '0,/\"cpus\": /s//&10/' @/moved/run.json");
    assert_int_equal(answer.code, 0);
    check_answer("compare @/moved @/b", 2, "its processes differ in processors: 10");
    check_answer("compare @/moved @/b", 2, ": processors 10");
    run_program(&answer, RUN
                "-o @/other --scene sphere --sweep spot=1..2 --cross model=phong,blinn");
    assert_int_equal(answer.code, 0);
    run_program(&answer, RUN "-o @/third --cross point=3..4 --cross dir=7..8");
    assert_int_equal(answer.code, 0);
    check_answer("compare @/other @/third", 2, "have no row in common");
}

static void words_that_are_wrong_are_answered_in_one_line(void **state)
{
    (void)state;
    make_run();
    check_answer("compare", 2, "valid: compare A B, compare --pareto RESULTS, ");
    check_answer("compare @/run", 2, "/run with what? valid: compare A B, ");
    check_answer("compare @/run @/run @/runs", 2, "/runs\" is one too many");
    check_answer("compare --pareto --check @/run", 2, "--check goes with two runs");
    check_answer("compare --force --terms @/run", 2, "--force goes with two runs");
    check_answer("compare @/run @/run --tolerance 2", 2, "2: a share is wanted");
    check_answer("compare @/run @/run --tolerance -1%", 2, "-1%: a share is wanted");
    check_answer("compare @/run @/run --tolerance ''", 2, "a share is wanted");
    check_answer("compare --pareto", 2, "wants a results folder");
    check_answer("compare --pareto @/run @/terms", 2, "takes one run");
    check_answer("compare --pareto --terms @/run", 2, "not both");
    check_answer("compare --paretto @/run", 2, "did you mean \"--pareto\"?");
    check_answer("compare --pareto --set point=1 @/run", 2, "unknown option");
    check_shell("exec $SB compare --terms @/nowhere 2>&1 >/dev/null | wc -l", 0, "1\n");
    check_shell("exec $SB compare --terms @/nowhere --json 2>/dev/null | wc -c", 0,
                "0\n");
}

static void results_that_are_none_are_answered_with_file_and_line(void **state)
{
    (void)state;
    check_answer("compare --pareto @/rum", 2, "/rum: there is no such folder or file");
    check_shell("mkdir @/bare", 0, "");
    check_answer("compare --pareto @/bare", 2, "/bare: the folder has no summary.csv");
    write_file("empty.csv", "");
    check_answer("compare --pareto @/empty.csv", 2, "empty.csv: empty");
    write_file("head.csv", "variant,scene,renderer,version,status\n");
    check_answer("compare --terms @/head.csv", 2, "head.csv: a header and no rows");
    write_file("less.csv", "variant,scene,renderer,version\na,b,c,d\n");
    check_answer("compare --pareto @/less.csv", 2, "less.csv:1: no column \"status\"");
    write_file("short.csv", "variant,scene,renderer,version,status\na,b,c\n");
    check_answer("compare --pareto @/short.csv", 2,
                 "short.csv:2: 3 fields; the header has 5");
    write_file("word.csv", "variant,scene,renderer,version,status,max_err\n"
                           "a,b,c,d,ok,much\n");
    check_answer("compare --pareto @/word.csv", 2,
                 "word.csv:2: line 2: max_err is \"much\", a number is wanted");
    write_file("status.csv", "variant,scene,renderer,version,status\na,b,c,d,fine\n");
    check_answer("compare --pareto @/status.csv", 2, "status is \"fine\"");
    write_file("none.csv", "variant,scene,renderer,version,status\na,,c,d,ok\n");
    check_answer("compare --pareto @/none.csv", 2, "none.csv:2: no scene");
    write_file("axis.csv", "variant,scene,stage,renderer,version,status\n"
                           "a,b,vretex,c,d,ok\n");
    check_answer("compare --pareto @/axis.csv", 2, "did you mean \"vertex\"?");
    check_answer("compare --pareto @/run/samples.csv", 2, "samples.csv:1: no column");
}

// Columns of later versions, and axes of today that a file of yesterday lacks.
static void other_columns_than_todays_do_no_harm(void **state)
{
    (void)state;
    write_file("old.csv", "variant,scene,stage,renderer,version,status,median_ms,colour\n"
                          "stage=vertex,sphere,vertex,c,d,ok,1.5,green\n"
                          "stage=fragment,sphere,fragment,c,d,ok,2.5,red\n");
    check_answer("compare --pareto @/old.csv", 0, "stage=fragment      2.500");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pareto_sorts_by_time_and_names_what_dominates),
        cmocka_unit_test(pareto_json_has_every_column_of_every_row),
        cmocka_unit_test(groups_are_told_apart_by_what_differs_between_them),
        cmocka_unit_test(the_table_of_run_shows_errors_and_the_front_where_there_are_any),
        cmocka_unit_test(terms_prices_the_suite_of_that_name),
        cmocka_unit_test(axes_of_a_suite_are_read_from_its_copy),
        cmocka_unit_test(two_runs_are_told_apart_row_by_row),
        cmocka_unit_test(one_process_a_side_is_said_to_be_no_gate),
        cmocka_unit_test(rows_that_moved_without_a_change_are_counted),
        cmocka_unit_test(check_ends_with_1_where_something_became_worse),
        cmocka_unit_test(check_ends_with_1_where_a_shader_is_broken),
        cmocka_unit_test(two_runs_as_json_have_every_row_and_count),
        cmocka_unit_test(runs_of_other_conditions_are_refused_with_the_reason),
        cmocka_unit_test(words_that_are_wrong_are_answered_in_one_line),
        cmocka_unit_test(results_that_are_none_are_answered_with_file_and_line),
        cmocka_unit_test(other_columns_than_todays_do_no_harm),
    };
    const int failed = run_tests(tests);
    sb_rows_free(&rows);
    return end_tests(failed);
}
