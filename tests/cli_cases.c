// shadebench verify of the hard cases on the null runner, which answers every point with zeros.
#include "cli_fixture.h"

static void the_matrix_and_the_files_say_what_does_not_hold(void **state)
{
    (void)state;
    check_answer(
        "verify dist-overflow16 --context null -q -o @/plain", 1,
        "1 case: 0 of 4 robust cells hold, 1 of 1 naive forms fail as they should");
    struct sb_csv csv;
    read_csv("plain/cases.csv", &csv);
    // Two precisions, since nothing is mediump there, two stages, two forms.
    assert_int_equal(csv.row_count, 1 + 8);
    assert_string_equal(csv.cell[0][0], "case");
    assert_string_equal(csv_cell(&csv, 2, "case"), "dist-overflow16");
    assert_string_equal(csv_cell(&csv, 2, "family"), "distance");
    assert_string_equal(csv_cell(&csv, 2, "form"), "robust");
    assert_string_equal(csv_cell(&csv, 2, "verdict"), "fail");
    assert_string_equal(csv_cell(&csv, 2, "figure"), "angle");
    assert_string_equal(csv_cell(&csv, 2, "of"), "direction");
    assert_string_equal(csv_cell(&csv, 2, "unit"), "deg");
    check_close(atof(csv_cell(&csv, 2, "measured")), 180, 1e-6);
    assert_string_equal(csv_cell(&csv, 2, "cost_pct"), "");
    assert_string_equal(csv_cell(&csv, 5, "precision"), "fp16");
    assert_string_equal(csv_cell(&csv, 5, "api"), "gl");
    sb_csv_free(&csv);
    char *junit = read_file("plain/junit.xml");
    check_contains(junit,
                   "<testsuite name=\"distance\" tests=\"8\" failures=\"4\" errors=\"0\" "
                   "skipped=\"0\">");
    check_contains(junit,
                   "<testcase classname=\"dist-overflow16\" name=\"robust highp "
                   "fragment\">\n      <failure message=\"fail: angle of direction: "
                   "180 &gt; 0.1 deg");
    free(junit);
    check_answer("verify dist-overflow16 --context null -q -o @/plain", 2,
                 "plain/cases.csv exists; name another folder with -o");
}

static void words_forms_and_precisions_pick_cells(void **state)
{
    (void)state;
    check_answer("verify light-order --context null -q -o @/one", 0,
                 "1 case: 2 of 2 robust cells hold");
    check_answer("verify relations light-order --form robust --precision highp --context "
                 "null -q -o @/family",
                 0, "9 cases: 9 of 9 robust cells hold");
    // Every precision: mediump is none here, and the note says so.
    check_answer("verify light-order --all --context null -q -o @/all", 0,
                 "n/a, 1 cell: the driver does not compute mediump in half precision");
    // A case that has no naive form is not asked.
    check_answer("verify light-order --form naive --context null -q -o @/none", 0,
                 "0 cases: ");
    check_answer("list cases", 0, "dist-overflow16 ");
    check_answer("list columns", 0, "cases.csv");
}

static void what_is_not_understood_is_refused(void **state)
{
    (void)state;
    check_answer("verify dist-overflow61", 2,
                 "did you mean \"dist-overflow16\"? valid: ");
    check_answer("verify relatoins", 2, "did you mean \"relations\"?");
    check_answer("verify --form robst", 2, "did you mean \"robust\"?");
    check_answer("verify --precision lowp", 2, "valid: highp mediump fp16 fixed10");
    check_answer("verify --all --precision highp", 2, "leave out --precision highp");
    check_answer("verify --search soon", 2, "--search");
    check_answer("verify --seed -1", 2, "--seed");
    check_answer("verify --set point=4", 2, "each case has a variant of its own");
    check_answer("verify --sweep point=1,2", 2, "each case has a variant of its own");
    check_answer("verify --classes --time", 2, "--time is of cases: leave out --classes");
}

static void json_has_every_cell(void **state)
{
    (void)state;
    json_t *json = run_json("verify light-on-surface light-order --precision highp "
                            "--context null --json -o @/json",
                            1);
    const json_t *cells = json_object_get(json, "cells");
    assert_int_equal(json_array_size(cells), 5);
    const json_t *cell = json_array_get(cells, 1);
    assert_string_equal(json_string_value(json_object_get(cell, "case")),
                        "light-on-surface");
    assert_string_equal(json_string_value(json_object_get(cell, "form")), "robust");
    assert_true(json_is_false(json_object_get(cell, "holds")));
    assert_true(json_is_null(json_object_get(cell, "cost_pct")));
    check_close(json_real_value(json_object_get(cell, "bound")), 0.5, 0);
    assert_true(json_is_true(json_object_get(json_array_get(cells, 4), "holds")));
    assert_int_equal(json_array_size(json_object_get(json, "prices")), 0);
    assert_true(json_is_false(json_object_get(json, "interrupted")));
    json_decref(json);
    json = run_json("verify light-on-surface --precision highp --context null --json "
                    "--time --search 2 -o @/json2",
                    1);
    const json_t *price = json_array_get(json_object_get(json, "prices"), 0);
    const json_t *guards = json_object_get(price, "guards");
    assert_string_equal(json_string_value(guards), "f_unit");
    assert_int_equal(json_integer_value(json_object_get(price, "pairs")), 120);
    const json_t *found = json_array_get(json_object_get(json, "found"), 0);
    assert_string_equal(json_string_value(json_object_get(found, "precision")), "highp");
    check_contains(json_string_value(json_object_get(found, "c")),
                   "static void found_1(");
    json_decref(json);
}

static void breaking_points_stand_in_text_and_rows(void **state)
{
    (void)state;
    check_answer(
        "verify dist-overflow16 light-order --precision highp --breaking --context "
        "null -q -o @/broken",
        1, "dist-overflow16: distance: highp not even at 1 units\n");
}

// The two programs differ, and the scripted times do not: the price is noise about nothing.
static void prices_are_ratios_of_pairs(void **state)
{
    (void)state;
    static struct answer answer;
    run_program(&answer, "verify light-on-surface light-order --precision highp --time "
                         "--context null -q -o @/time");
    assert_int_equal(answer.code, 1); // of zeros
    check_contains(answer.text, "timer: scripted, within 0.0 %");
    check_contains(answer.text, "one form only: light-order");
    struct sb_csv csv;
    read_csv("time/cases.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "form"), "naive");
    assert_string_equal(csv_cell(&csv, 1, "cost_pct"), "");
    const double cost = atof(csv_cell(&csv, 2, "cost_pct"));
    const double low = atof(csv_cell(&csv, 2, "cost_lo_pct"));
    const double high = atof(csv_cell(&csv, 2, "cost_hi_pct"));
    assert_true(low < cost && cost < high);
    assert_true(low > -2 && high < 2);
    assert_string_equal(csv_cell(&csv, 4, "stage"), "vertex");
    assert_string_equal(csv_cell(&csv, 4, "cost_pct"), "");
    sb_csv_free(&csv);
    read_csv("time/time/summary.csv", &csv);
    assert_string_equal(csv_cell(&csv, 1, "point"), "8");
    assert_string_equal(csv_cell(&csv, 1, "rounds"), "120");
    sb_csv_free(&csv);
}

static void a_search_says_what_it_found(void **state)
{
    (void)state;
    static struct answer answer;
    // Zeros are wrong almost everywhere.
    run_program(&answer,
                "verify light-order --precision highp --search 2 --seed 3 --context "
                "null -q -o @/found");
    assert_int_equal(answer.code, 1);
    check_contains(answer.text, "search, robust highp, seed 3, 2 s: ");
    check_contains(answer.text, ".id = \"found-1\"");
    check_contains(answer.text, "1 case: 1 of 1 robust cells hold");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_matrix_and_the_files_say_what_does_not_hold),
        cmocka_unit_test(words_forms_and_precisions_pick_cells),
        cmocka_unit_test(what_is_not_understood_is_refused),
        cmocka_unit_test(json_has_every_cell),
        cmocka_unit_test(breaking_points_stand_in_text_and_rows),
        cmocka_unit_test(prices_are_ratios_of_pairs),
        cmocka_unit_test(a_search_says_what_it_found),
    };
    return end_tests(run_tests(tests));
}
