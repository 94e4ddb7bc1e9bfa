// shadebench run --resume: what is gone on with, and what is refused.
#include "cli_fixture.h"

#define RUN "run --context null -q --sweep point=1,2,4 --rounds 20 --first-look 10 "

static void copy_folder(const char *name)
{
    char line[256];
    snprintf(line, sizeof line, "cp -r @/done @/%s", name);
    check_shell(line, 0, "");
}

static void a_complete_run_is_shown_and_not_measured_again(void **state)
{
    (void)state;
    static struct answer first, again;
    run_program(&first, RUN "-o @/complete");
    assert_int_equal(first.code, 0);
    char *before = read_file("complete/samples.csv");
    run_program(&again, "run --resume @/complete");
    assert_int_equal(again.code, 0);
    check_contains(again.text, "nothing is measured");
    // The same table, from the files alone.
    check_contains(again.text, strstr(first.text, "driver:"));
    char *after = read_file("complete/samples.csv");
    assert_string_equal(before, after);
    free(before);
    free(after);
    json_t *json = run_json("run --resume @/complete --json", 0);
    const json_t *row = json_array_get(json_object_get(json, "rows"), 1);
    assert_string_equal(json_string_value(json_object_get(row, "variant")),
                        "context=null,point=2");
    check_close(json_number_value(json_object_get(row, "point")), 2, 0);
    assert_string_equal(json_string_value(json_object_get(row, "storage")), "uniform");
    json_decref(json);
}

static void more_processes_are_added_to_a_complete_run(void **state)
{
    (void)state;
    struct sb_csv csv;
    copy_folder("more");
    check_answer("run --resume @/more --processes 3", 0, "ci95_between_processes");
    read_csv("more/samples.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 3 * 3 * 20);
    assert_string_equal(csv_cell(&csv, csv.row_count - 1, "process"), "2");
    sb_csv_free(&csv);
    assert_true(run_is_complete("more/run.json"));
    // Asked for once, it stays asked for.
    check_answer("run --resume @/more", 0, "more processes: --processes 4");
}

static void another_plan_is_refused(void **state)
{
    (void)state;
    static const char *const options[] = {
        "--set point=4", "--sweep point=1,2", "--cross stage=vertex", "--scene plane",
        "--context egl", "--timer wall",      "--shaders /tmp",       "--images",
        "--preset x",    "--device 0",        "-o @/elsewhere",       "lights"};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        char line[256];
        snprintf(line, sizeof line, "run --resume @/done --processes 2 %s", options[i]);
        check_answer(line, 2, "--resume goes on with the plan");
    }
    check_answer("run --resume @/done --set point=4", 2, "leave out --set point=4");
    write_file("suite.yaml", "suite: changed\nbase: {context: null}\n"
                             "sweep: {point: [1, 2]}\nmeasure: {rounds: 20}\n");
    check_answer("run -q @/suite.yaml -o @/changed", 0, "median ms");
    check_shell("sed -i s/1,.2/1,3/ @/changed/suite.yaml", 0, "");
    check_answer("run --resume @/changed --processes 2", 2,
                 "variant 1 is context=null,point=2 on containers, but the suite has "
                 "context=null,point=3");
}

// Whatever is damaged is refused in one line, and left as it is.
static void check_damaged(const char *name, const char *damage, const char *part)
{
    static struct answer answer;
    char line[512];
    copy_folder(name);
    snprintf(line, sizeof line, "cd @/%s && %s && cksum samples.csv 2>&1 >../sum; true",
             name, damage);
    check_shell(line, 0, "");
    snprintf(line, sizeof line, "run --resume @/%s --processes 2 -q", name);
    run_program(&answer, line);
    if (answer.code != 2 || !strstr(answer.text, part) || count_lines(answer.text) != 1)
        fail_msg("%s: exit code %d: %s", damage, answer.code, answer.text);
    snprintf(line, sizeof line, "cd @/%s; cksum samples.csv 2>&1 | cmp - ../sum", name);
    check_shell(line, 0, "");
}

static void damaged_folders_are_refused_in_one_line(void **state)
{
    (void)state;
    check_damaged("d0", "rm run.json", "run.json: No such file");
    check_damaged("d1", "echo '{' >run.json", "run.json:");
    check_damaged("d2", "echo '[]' >run.json", "run.json: not the record of a run");
    check_damaged("d3", "rm samples.csv && : >samples.csv", "samples.csv: empty");
    check_damaged("d4", "sed -i 1s/process/proc/ samples.csv", "not the columns");
    check_damaged("d5", "sed -i '1s/round,place/place,round/' samples.csv",
                  "not the columns");
    check_damaged("d6", "sed -i '5s/,scripted/,scripted,/' samples.csv",
                  "samples.csv:5: 13 fields; the header has 12");
    check_damaged("d7", "sed -i 5s/point=/poimt=/ samples.csv", "samples.csv:5: ");
    check_damaged("d8", "sed -i 5s/^0/-3/ samples.csv", "samples.csv:5: damaged");
    check_damaged("d9", "sed -i 5s/^0/99999999999/ samples.csv",
                  "samples.csv:5: damaged");
    check_damaged("d10", "sed -i 5s/^0/zero/ samples.csv",
                  "samples.csv: line 5: process");
    check_damaged("d11", "sed -i '5s/,[0-9]*$/,/' samples.csv", "samples.csv:5: damaged");
    check_damaged("d12", "printf '\\0\\0\\0' >samples.csv", "samples.csv: empty");
    check_answer("run --resume @/nowhere", 2, "nowhere/run.json: No such file");
}

int main(void)
{
    static struct answer answer;
    begin_tests();
    run_program(&answer, RUN "-o @/done");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_complete_run_is_shown_and_not_measured_again),
        cmocka_unit_test(more_processes_are_added_to_a_complete_run),
        cmocka_unit_test(another_plan_is_refused),
        cmocka_unit_test(damaged_folders_are_refused_in_one_line),
    };
    return end_tests(run_tests(tests));
}
