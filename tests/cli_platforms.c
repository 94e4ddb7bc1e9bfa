// A plan over several platforms is a run of each, and one summary of all.
#include "cli_fixture.h"

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
    check_answer(PLAN "-o @/two", 2, "holds results already");
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
        cmocka_unit_test(one_of_them_can_be_asked_for),
        cmocka_unit_test(json_is_of_all_of_them),
        cmocka_unit_test(budgets_are_held_against_all_of_them),
        cmocka_unit_test(what_no_platform_can_have_is_told_by_the_exit_code),
    };
    begin_tests();
    return end_tests(run_tests(tests));
}
