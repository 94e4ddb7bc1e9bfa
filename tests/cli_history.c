// shadebench history: add on the null context, and show of histories that the tests make.
#include "cli_fixture.h"
#include "history_rows.h"

#define ADD "history add --context null -q --sweep point=1,2 --pairs 20 --processes 1 "

static void write_history(const char *name)
{
    struct sb_text text = {0};
    sb_csv_header(&text, sb_history_columns, sb_history_column_count, NULL);
    for (int i = 0; i < history_count; i++)
        sb_csv_row(&text, sb_history_columns, sb_history_column_count, NULL,
                   &history_row[i]);
    write_file(name, text.data);
    sb_text_free(&text);
}

// Two variants over 30 commits: one creeps by half a percent in each of ten, one stays.
static void make_history(void)
{
    history_count = 0;
    for (int i = 0; i < 30; i++) {
        const int crept = i < 10 ? 0 : i < 20 ? i - 9 : 10;
        const double noise = 1 + 0.001 * (i * 7 % 5 - 2);
        add_ratio(i, 0.5 * pow(1.005, crept) * noise);
        add_ratio(i, 0.25 * noise)->variant = "spot=4,stage=vertex";
    }
    write_history("creep.csv");
}

// --- add ---------------------------------------------------------------------------------------

static void add_appends_a_row_a_variant(void **state)
{
    (void)state;
    struct sb_csv csv;
    check_answer(ADD "--commit one --date 2026-11-22T03:00:00+02:00 --file @/h.csv", 0,
                 "2 rows appended to");
    check_answer(ADD "--commit two --date 2026-11-23 --file @/h.csv", 0,
                 "history command-line: commit two of 2026-11-23T00:00:00Z");
    read_csv("h.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 4);
    assert_int_equal(csv.column_count, sb_history_column_count);
    assert_string_equal(csv_cell(&csv, 1, "time"), "2026-11-22T01:00:00Z");
    assert_string_equal(csv_cell(&csv, 1, "commit"), "one");
    assert_string_equal(csv_cell(&csv, 4, "commit"), "two");
    check_contains(csv_cell(&csv, 4, "variant"), "point=2");
    assert_string_equal(csv_cell(&csv, 4, "scene"), "containers");
    assert_string_equal(csv_cell(&csv, 4, "metric"), "gpu");
    assert_string_equal(csv_cell(&csv, 4, "status"), "ok");
    assert_string_equal(csv_cell(&csv, 4, "pairs"), "20");
    assert_string_equal(csv_cell(&csv, 4, "anchor"), csv_cell(&csv, 1, "anchor"));
    assert_int_equal(strlen(csv_cell(&csv, 4, "anchor")), 16);
    // The null runner's frames cost 0.2 ms and what the lights add: 8 for the anchor.
    const double one = strtod(csv_cell(&csv, 3, "ratio"), NULL),
                 two = strtod(csv_cell(&csv, 4, "ratio"), NULL);
    assert_true(0.5 < one && one < two && two < 1);
    sb_csv_free(&csv);
    check_answer("history show --file @/h.csv --json", 0, "\"crept\": false");
}

static void add_says_in_json_what_it_appended(void **state)
{
    (void)state;
    json_t *json = run_json(ADD "--commit one --file @/json.csv --json", 0);
    assert_true(json_is_true(json_object_get(json, "appended")));
    const json_t *rows = json_object_get(json, "rows"), *row = json_array_get(rows, 1);
    assert_int_equal(json_array_size(rows), 2);
    assert_int_equal(json_object_size(row), sb_history_column_count);
    assert_string_equal(json_string_value(json_object_get(row, "commit")), "one");
    assert_true(json_real_value(json_object_get(row, "ratio")) > 0);
    json_decref(json);
}

static void the_commit_is_that_of_the_shader_folder(void **state)
{
    (void)state;
    struct sb_csv csv;
    if (system("git --version >/dev/null 2>&1") != 0)
        skip();
    check_shell("mkdir @/repo && cp -r '" SB_SOURCE_DIR "/shaders' @/repo/shaders && "
                "cd @/repo && git init -q && git add . && "
                "git -c user.name=n -c user.email=e commit -q -m first && "
                "git rev-parse HEAD >@/head",
                0, "");
    check_answer(ADD "--shaders @/repo/shaders --file @/git.csv", 0, "2 rows appended");
    char *head = read_file("head");
    head[strcspn(head, "\n")] = '\0';
    read_csv("git.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "commit"), head);
    sb_csv_free(&csv);
    // What no commit has is measured under a name that the user gives.
    check_shell("echo >>@/repo/shaders/shade.vert", 0, "");
    check_answer(ADD "--shaders @/repo/shaders --file @/git.csv", 2, "--commit ID");
    check_answer(ADD "--shaders @/repo/shaders --file @/git.csv --commit mine", 0,
                 "mine");
    free(head);
    check_shell("cp -r '" SB_SOURCE_DIR "/shaders' @/alone", 0, "");
    check_answer(ADD "--shaders @/alone --file @/alone.csv", 2,
                 "--commit ID: which commit is measured?");
    check_shell("test -e @/alone.csv", 1, "");
}

static void nothing_is_measured_for_a_file_that_cannot_be_appended_to(void **state)
{
    (void)state;
    write_file("other.csv", "a,b\n1,2\n");
    check_answer(ADD "--commit one --file @/other.csv", 2,
                 "other.csv:1: is not the header of a history");
    check_answer(ADD "--commit one --file @/none/h.csv", 2, "No such file");
    check_answer(ADD "--commit one --file @", 2, "Is a directory");
    // Before: what could not be measured either is not asked.
    check_answer(ADD "--commit one --timer elapsd --file @/other.csv", 2,
                 "is not the header");
    check_answer(ADD "--commit one --timer elapsd --file @/good.csv", 2, "unknown timer");
    char *text = read_file("other.csv");
    assert_string_equal(text, "a,b\n1,2\n");
    free(text);
}

static void a_full_disk_is_no_success(void **state)
{
    (void)state;
    check_answer(ADD "--commit one --file @/small.csv", 0, "2 rows");
    char *before = read_file("small.csv");
    // dash counts blocks of 512 bytes; the header and two rows are more than one.
    check_shell("trap '' XFSZ; ulimit -f 1; exec $SB " ADD
                "--commit two --file @/small.csv 2>&1",
                3, "small.csv: File too large; the rows written before are whole");
    // What was measured is shown all the same.
    check_shell("trap '' XFSZ; ulimit -f 1; exec $SB " ADD
                "--commit two --file @/small.csv 2>/dev/null",
                3, "2 rows NOT appended to ");
    char *after = read_file("small.csv");
    assert_string_equal(after, before);
    free(before);
    free(after);
}

static void wrong_words_and_options_are_answered(void **state)
{
    (void)state;
    static const struct {
        const char *line, *answer;
    } wrong[] = {
        {"history", "history what? valid: history add [SUITE], history show"},
        {"history shwo", "did you mean \"show\"?"},
        {"history add ci more", "\"more\" is one too many"},
        {"history add cj", "unknown suite \"cj\""},
        {"history show x", "--variant \"x\" may be meant"},
        {"history add --variant x", "--variant goes with history show"},
        {"history add --check", "--check goes with history show"},
        {"history add --recent 3", "--recent goes with history show"},
        {"history show --pairs 30", "--pairs goes with history add"},
        {"history show --commit x", "--commit goes with history add"},
        {"history show --set point=4", "--set point=4 goes with history add"},
        {"history show --budget 4", "--budget 4 goes with history add"},
        {"history show --wide --json", "--wide or --json, not both"},
        {"history show --wide --check", "--wide or --check, not both"},
        {"history show --tolerance 2", "--tolerance 2: a share is wanted"},
        {"history show --recent -1", "--recent -1: a whole number from 0"},
        {"history show --file /nowhere.csv", "/nowhere.csv: No such file"},
        {ADD "--commit 'a b'", "--commit \"a b\": a word"},
        {ADD "--commit a,b", "without commas"},
        {ADD "--commit ''", "--commit \"\""},
        {ADD "--commit a --date yesterday",
         "\"yesterday\" is no date; valid: 2026-11-22"},
        {ADD "--commit a --pairs 5", "--pairs 5: a whole number from 6"},
        {ADD "--commit a --metric gpus", "did you mean \"gpu\"?"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        check_answer(wrong[i].line, 2, wrong[i].answer);
}

static void the_default_suite_is_ci(void **state)
{
    (void)state;
    check_answer("history add --context null -q --pairs 10 --processes 1 --commit a "
                 "--file @/ci.csv",
                 0, "history ci: commit a");
    check_answer("history add lights --context null -q --pairs 10 --processes 1 "
                 "--commit a --file @/lights.csv",
                 0, "history lights: commit a");
}

// --- show --------------------------------------------------------------------------------------

static void show_tells_levels_changes_and_creep(void **state)
{
    (void)state;
    static struct answer answer;
    make_history();
    run_program(&answer, "history show --file @/creep.csv");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text,
                   "cpu on llvmpipe (LLVM 15.0.6, 256 bits), 4.5 Mesa 22.3.6, "
                   "threads 1, against the anchor 00000000000000aa\n");
    check_contains(answer.text,
                   "containers  point=4,stage=fragment       30  0.4990  0.5");
    check_contains(answer.text, "containers  spot=4,stage=vertex          30  0.2495");
    check_contains(answer.text, " % !  ▁");
    check_contains(answer.text, "containers point=4,stage=fragment: +");
    check_contains(answer.text, " since the first level\n");
    check_contains(answer.text, "\n1 of 2 series are over their first level by more than "
                                "2 %; ");
    assert_null(strstr(answer.text, "containers spot=4,stage=vertex: "));
    run_program(&answer, "history show --file @/creep.csv --variant 'spot*'");
    check_contains(answer.text, "\n0 of 1 series");
    assert_null(strstr(answer.text, "point=4"));
    check_answer("history show --file @/creep.csv --variant 'area*'", 2,
                 "no variant matches \"area*\"");
}

static void check_fails_for_a_creep_and_for_a_recent_step(void **state)
{
    (void)state;
    make_history();
    check_answer("history show --check --file @/creep.csv", 1, "1 of 2");
    check_answer("history show --check --file @/creep.csv --variant 'spot*'", 0,
                 "0 of 1");
    check_answer("history show --check --file @/creep.csv --tolerance 10%", 0, "0 of 2");
    history_count = 0;
    for (int i = 0; i < 30; i++)
        add_ratio(i, i < 10 ? 1 : i < 22 ? 0.8 : 0.9);
    write_history("step.csv");
    check_answer("history show --check --file @/step.csv", 1,
                 "0 of 1 series are over their first level by more than 2 %; 1 went up");
    check_answer("history show --check --recent 5 --file @/step.csv", 0, "0 went up");
    check_answer("history show --file @/step.csv", 0, "1 went up");
}

static void show_never_joins_drivers_or_anchors(void **state)
{
    (void)state;
    static struct answer answer;
    history_count = 0;
    for (int i = 0; i < 30; i++) {
        struct sb_history_row *row = add_ratio(i, i < 10 ? 1 : i < 20 ? 2 : 4);
        if (i >= 10)
            row->renderer = "another driver";
        if (i >= 20)
            row->anchor = "00000000000000bb";
    }
    write_history("apart.csv");
    run_program(&answer, "history show --check --file @/apart.csv");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "\ncpu on another driver, 4.5 Mesa 22.3.6, threads 1, "
                                "against the anchor 00000000000000aa\n");
    check_contains(answer.text, "against the anchor 00000000000000bb\n");
    check_contains(answer.text, "\n0 of 3 series");
}

static void json_has_every_point_and_level(void **state)
{
    (void)state;
    make_history();
    json_t *json = run_json("history show --file @/creep.csv --json", 0);
    const json_t *list = json_object_get(json, "series"),
                 *creep = json_array_get(list, 0);
    const json_t *segments = json_object_get(creep, "segments"), *segment;
    assert_int_equal(json_array_size(list), 2);
    assert_int_equal(json_array_size(json_object_get(creep, "points")), 30);
    assert_string_equal(json_string_value(json_object_get(creep, "renderer")),
                        history_row[0].renderer);
    size_t s;
    int commits = 0;
    double level = 0;
    json_array_foreach(segments, s, segment)
    {
        commits += (int)json_integer_value(json_object_get(segment, "commits"));
        level = json_real_value(json_object_get(segment, "level"));
        assert_true(json_is_null(json_object_get(segment, "before")) == (s == 0));
    }
    assert_int_equal(commits, 30);
    const double first =
        json_real_value(json_object_get(json_array_get(segments, 0), "level"));
    check_close(json_real_value(json_object_get(creep, "creep")), level / first - 1,
                1e-12);
    assert_true(json_is_true(json_object_get(creep, "crept")));
    json_decref(json);
}

// Python's csv and float, which Otava's importer uses, read it.
static void wide_has_a_column_a_variant(void **state)
{
    (void)state;
    static struct answer answer;
    make_history();
    history_row[4].ratio = NAN; // of the third commit
    history_row[4].status = "compile_failed";
    add_ratio(40, 7)->threads = "2"; // the first of another set-up
    history_row[history_count - 1].time = "2025-01-01T00:00:00Z";
    struct sb_history_row first = history_row[history_count - 1];
    memmove(history_row + 1, history_row, (size_t)(history_count - 1) * sizeof first);
    history_row[0] = first;
    write_history("wide.csv");
    run_shell(&answer, "$SB history show --file @/wide.csv --wide 2>@/said");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text,
                   "time,commit,\"point=4,stage=fragment\",\"spot=4,stage=vertex\"\n"
                   "2026-01-01T00:00:00Z,c000,0.499,0.2495\n");
    assert_int_equal(count_lines(answer.text), 1 + 29);
    assert_null(strstr(answer.text, "c002"));
    assert_null(strstr(answer.text, ",7"));
    char *said = read_file("said");
    check_contains(said, "1 series of another driver, metric or anchor");
    check_contains(said, "1 commits at which a variant has no ratio are left out");
    free(said);
    history_row[history_count - 1].scene = "room";
    write_history("wide.csv");
    run_shell(&answer, "$SB history show --file @/wide.csv --wide 2>/dev/null");
    check_contains(answer.text, ",\"containers/point=4,stage=fragment\",");
    check_contains(answer.text, ",\"room/spot=4,stage=vertex\"\n");
}

static void a_history_without_rows_is_no_failure(void **state)
{
    (void)state;
    history_count = 0;
    write_history("none.csv");
    check_answer("history show --check --file @/none.csv", 0, "none.csv: no rows yet");
}

// The job of docs/history.md, as it stands there.
static void the_job_of_the_docs_works(void **state)
{
    (void)state;
    check_shell("awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' "
                "'" SB_SOURCE_DIR "/docs/history.md' >@/job && cat @/job",
                0, "shadebench history add");
    check_shell(
        "mkdir -p @/bin @/job-dir && "
        "printf '#!/bin/sh\\ncase $2 in add) set -- $* --context null --commit abc "
        "--pairs 10;; esac\\nexec %s $*\\n' $SB >@/bin/shadebench && "
        "chmod +x @/bin/shadebench && cd @/job-dir && PATH=@/bin:$PATH sh -e @/job "
        "2>&1",
        0, "0 of 20 series are over their first level by more than 2 %");
}

static void the_docs_have_every_column(void **state)
{
    (void)state;
    for (int c = 0; c < sb_history_column_count; c++) {
        char line[256];
        snprintf(line, sizeof line,
                 "sed -n '/^## History/,/^## One/p' '" SB_SOURCE_DIR
                 "/docs/formats.md' | grep -c '^| `%s` | '",
                 sb_history_columns[c].name);
        check_shell(line, 0, "1\n");
    }
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(add_appends_a_row_a_variant),
        cmocka_unit_test(add_says_in_json_what_it_appended),
        cmocka_unit_test(the_commit_is_that_of_the_shader_folder),
        cmocka_unit_test(nothing_is_measured_for_a_file_that_cannot_be_appended_to),
        cmocka_unit_test(a_full_disk_is_no_success),
        cmocka_unit_test(wrong_words_and_options_are_answered),
        cmocka_unit_test(the_default_suite_is_ci),
        cmocka_unit_test(show_tells_levels_changes_and_creep),
        cmocka_unit_test(check_fails_for_a_creep_and_for_a_recent_step),
        cmocka_unit_test(show_never_joins_drivers_or_anchors),
        cmocka_unit_test(json_has_every_point_and_level),
        cmocka_unit_test(wide_has_a_column_a_variant),
        cmocka_unit_test(a_history_without_rows_is_no_failure),
        cmocka_unit_test(the_job_of_the_docs_works),
        cmocka_unit_test(the_docs_have_every_column),
    };
    return end_tests(run_tests(tests));
}
