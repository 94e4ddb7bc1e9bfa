// shadebench fit, on results folders that the tests make.
#include "cli_rows.h"

static double lights_cost(const double *value)
{
    const double dir = value[SB_AXIS_DIR], point = value[SB_AXIS_POINT],
                 spot = value[SB_AXIS_SPOT], area = value[SB_AXIS_AREA];
    return 0.5 + (dir + point + spot + area > 0 ? 0.25 : 0) + 0.2 * dir + 0.25 * point +
           0.3 * spot + 0.4 * area;
}

// The shipped suite with costs that are known; per vertex a tenth, on the sphere until the
// triangles outnumber the pixels.
static void make_run(void)
{
    static struct answer answer;
    if (rows.count)
        return;
    run_program(&answer, RUN "fit -o @/run");
    if (answer.code != 0)
        fail_msg("%s", answer.text);
    read_rows("run/summary.csv");
    for (int i = 0; i < rows.count; i++) {
        const double *value = rows.variant[i].value;
        const bool vertex = value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
        double ms = lights_cost(value) / (vertex ? 10 : 1);
        if (strcmp(rows.row[i].scene, "sphere") == 0) {
            rows.row[i].fragments = 10000;
            rows.row[i].vertices = 3 * (int64_t)value[SB_AXIS_TESSELLATION];
            ms = vertex ? value[SB_AXIS_TESSELLATION] / 30000 : 1;
        }
        set_time(&rows.row[i], ms);
    }
    write_rows("run/summary.csv");
}

static void the_shipped_suite_has_all_that_fit_asks_for(void **state)
{
    (void)state;
    static struct answer answer;
    make_run();
    run_program(&answer, "fit @/run");
    assert_int_equal(answer.code, 0);
    check_contains(answer.text, "ci95_within_run: another process may differ by more");
    check_contains(answer.text, "\ncontainers stage=fragment\n"
                                "without lights 0.500 ms; lit 0.750 ms");
    check_contains(answer.text, "\ncontainers stage=vertex\n");
    check_contains(answer.text,
                   "\ndir    1 2 4 6 8 10 12 16      0.2000  [0.2000, 0.2000]");
    check_contains(answer.text,
                   "\narea   1 2 4 6 8 10 12 16      0.4000  [0.4000, 0.4000]");
    check_contains(answer.text, "\ndir=2 point=3 spot=2 ");
    check_contains(answer.text, "all of them are within 10 %\n");
    assert_null(strstr(answer.text, "wrong"));
    check_contains(
        answer.text,
        "\nsphere point=4 width=64 height=64: stage fragment against vertex\n");
    check_contains(answer.text,
                   "vertex is faster below, fragment above 3 triangles a pixel [");
    check_answer("fit @/run/summary.csv", 0, "dir=2 point=3 spot=2");
}

static void lights_fit_in_the_times_asked_for_and_not_beyond_the_measured(void **state)
{
    (void)state;
    static struct answer answer;
    make_run();
    run_program(&answer, "fit @/run --ms 8,0.6,0.1,2.01");
    assert_int_equal(answer.code, 0);
    const char *table = strstr(answer.text, "lights that fit in  0.1 ms ");
    assert_non_null(table);
    // 0.75 + 0.2 n, rows a hundredth up or down; ascending in ms.
    const char *dir = strstr(table, "\ndir ");
    char cell[4][32];
    assert_int_equal(sscanf(dir, " dir %31[^]]] %31[^]]] %31[^]]] %31[^]]]", cell[0],
                            cell[1], cell[2], cell[3]),
                     4);
    assert_string_equal(cell[0], "floor [floor, floor");
    assert_string_equal(cell[1], "0 [0, 0");
    assert_string_equal(cell[2], "6 [6, 6");
    assert_string_equal(cell[3], ">16 [>16, >16");
    check_contains(answer.text, "\n>N: more than N, not measured\n");
    check_contains(answer.text, "\nfloor: the frame without them takes longer\n");
}

static void mixes_that_are_off_are_called_wrong(void **state)
{
    (void)state;
    static struct answer answer;
    make_run();
    int changed = 0;
    for (int i = 0; i < rows.count; i++)
        if (rows.variant[i].value[SB_AXIS_POINT] == 8 &&
            rows.variant[i].value[SB_AXIS_SPOT] == 4 && changed++ == 0)
            set_time(&rows.row[i], 0.8 * rows.row[i].median_ms);
    assert_int_equal(changed, 2);
    write_rows("wrong.csv");
    run_program(&answer, "fit @/wrong.csv");
    check_contains(answer.text, "-20.0 %  wrong\n");
    check_contains(answer.text, "off by more than 10 %: 1 of 6 mixes; the model is wrong "
                                "there: types together cost less than their sum\n");
    check_contains(answer.text, "outside their interval: 1 of 6");
    read_rows("run/summary.csv");
}

static void json_has_the_numbers_of_the_text(void **state)
{
    (void)state;
    make_run();
    json_t *json = run_json("fit @/run --ms 2 --json", 0);
    const json_t *groups = json_object_get(json, "groups");
    assert_int_equal(json_array_size(groups), 2);
    const json_t *group = json_array_get(groups, 0);
    check_close(json_number_value(json_object_get(group, "lit_ms")), 0.75, 1e-9);
    const json_t *types = json_object_get(group, "types");
    assert_int_equal(json_array_size(types), 4);
    const json_t *dir = json_array_get(types, 0);
    assert_string_equal(json_string_value(json_object_get(dir, "type")), "dir");
    assert_string_equal(json_string_value(json_object_get(dir, "shape")), "line");
    check_close(
        json_number_value(json_object_get(json_object_get(dir, "ms_a_light"), "point")),
        0.2, 1e-9);
    const json_t *fits = json_array_get(json_object_get(dir, "fit_in"), 0);
    assert_int_equal(
        json_integer_value(json_object_get(json_object_get(fits, "lights"), "n")), 6);
    const json_t *mixes = json_object_get(group, "mixes");
    assert_int_equal(json_array_size(mixes), 6);
    check_close(json_number_value(json_object_get(json_array_get(mixes, 0), "off")), 0,
                1e-9);
    const json_t *series = json_array_get(json_object_get(json, "crossings"), 0);
    const json_t *at = json_array_get(json_object_get(series, "crossings"), 0);
    assert_string_equal(json_string_value(json_object_get(at, "faster_below")), "vertex");
    json_decref(json);
}

static void rows_that_are_not_valid_are_left_out_and_counted(void **state)
{
    (void)state;
    make_run();
    rows.row[2].status = "samples_invalid";
    rows.row[4].status = "samples_invalid";
    write_rows("some.csv");
    check_answer("fit @/some.csv", 0, "\n2 rows have no valid time and are left out\n");
    for (int i = 0; i < rows.count; i++)
        rows.row[i].status = "samples_invalid";
    write_rows("none.csv");
    check_answer("fit @/none.csv", 2, "of 0 rows with a valid time");
    read_rows("run/summary.csv");
}

static void what_cannot_be_fitted_is_answered_in_one_line(void **state)
{
    (void)state;
    make_run();
    check_answer("fit", 2, "fit wants a results folder");
    check_answer("fit @/run @/run", 2, "fit takes one run");
    check_answer("fit @/nowhere", 2, "/nowhere: there is no such folder or file");
    check_shell("mkdir @/bare", 0, "");
    check_answer("fit @/bare", 2, "/bare: the folder has no summary.csv");
    check_answer("fit @/run --ms 4,x", 2, "--ms 4,x: \"x\" is no time");
    check_answer("fit @/run --ms 4,-1", 2, "\"-1\" is no time");
    check_answer("fit @/run --ms ''", 2, "\"\" is no time");
    check_answer("fit @/run --ms 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17", 2,
                 "more than 16 times");
    check_answer("fit @/run --set point=1", 2, "unknown option");
    check_answer("fit --help", 0, "--ms N,…");
    check_shell("exec $SB " RUN "-o @/two --sweep point=1,2 >/dev/null 2>&1", 0, "");
    check_answer("fit @/two", 2,
                 "of 2 rows with a valid time no 3 differ in the count of one type");
    check_shell("exec $SB fit @/two --json 2>/dev/null | wc -c", 0, "0\n");
    check_shell("exec $SB fit @/two 2>&1 >/dev/null | wc -l", 0, "1\n");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shipped_suite_has_all_that_fit_asks_for),
        cmocka_unit_test(lights_fit_in_the_times_asked_for_and_not_beyond_the_measured),
        cmocka_unit_test(mixes_that_are_off_are_called_wrong),
        cmocka_unit_test(json_has_the_numbers_of_the_text),
        cmocka_unit_test(rows_that_are_not_valid_are_left_out_and_counted),
        cmocka_unit_test(what_cannot_be_fitted_is_answered_in_one_line),
    };
    const int failed = run_tests(tests);
    sb_rows_free(&rows);
    return end_tests(failed);
}
