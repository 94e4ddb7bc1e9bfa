// The text of the matrix, of cells that are made up.
#include "test.h"

#include "cases/matrix_text.h"

static const struct sb_case rows[] = {
    {.id = "one",
     .form = {"form=naive", ""},
     .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
     .scale = {"distance", "units", 1, 3e4, NULL}},
    {.id = "two", .form = {"form=naive", ""}, .holds = "floats are wide enough"},
    {.id = "three", .form = {"form=naive", ""}, .on_cpu = true},
};
static const struct sb_case_family families[] = {{"near", "what is near", rows, 2},
                                                 {"far", "what is far", rows + 2, 1}};

static struct sb_matrix matrix;

static struct sb_matrix_cell *put(int row, enum sb_case_form form,
                                  enum sb_case_precision precision, bool vertex,
                                  enum sb_verdict verdict, double measured, double bound)
{
    matrix.cell =
        sb_grow(matrix.cell, matrix.count, &matrix.capacity, sizeof *matrix.cell);
    struct sb_matrix_cell *cell = &matrix.cell[matrix.count++];
    *cell = (struct sb_matrix_cell){
        .it = &rows[row],
        .family = &families[row == 2],
        .form = form,
        .precision = precision,
        .vertex = vertex,
        .outcome = {verdict, SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, measured, bound, 3, {0}},
        .cost = NAN,
        .holds_to = NAN,
    };
    return cell;
}

static void note(struct sb_matrix_cell *cell, const char *words)
{
    sb_text_add(&cell->outcome.note, words);
}

static int fill(void **state)
{
    (void)state;
    // Per vertex the naive form is further off.
    put(0, SB_CASE_NAIVE, SB_CASE_HIGHP, false, SB_VERDICT_FAIL, 2, 0.5);
    put(0, SB_CASE_ROBUST, SB_CASE_HIGHP, false, SB_VERDICT_PASS, 0.25, 0.5);
    put(0, SB_CASE_NAIVE, SB_CASE_HIGHP, true, SB_VERDICT_FAIL, 44, 0.5);
    note(put(0, SB_CASE_ROBUST, SB_CASE_HIGHP, true, SB_VERDICT_NA, NAN, NAN), "no room");
    put(0, SB_CASE_NAIVE, SB_CASE_EMULATED, false, SB_VERDICT_FAIL, INFINITY, 4);
    note(put(0, SB_CASE_ROBUST, SB_CASE_EMULATED, false, SB_VERDICT_FAIL, 5, 4), "hm");
    put(1, SB_CASE_NAIVE, SB_CASE_HIGHP, false, SB_VERDICT_PASS, 0.25, 0.5);
    note(put(1, SB_CASE_ROBUST, SB_CASE_HIGHP, false, SB_VERDICT_FAIL, NAN, NAN),
         "does not compile");
    note(put(2, SB_CASE_NAIVE, SB_CASE_HIGHP, false, SB_VERDICT_NA, NAN, NAN), "no room");
    put(2, SB_CASE_ROBUST, SB_CASE_HIGHP, false, SB_VERDICT_REFUSED, NAN, NAN);
    return 0;
}

static int empty(void **state)
{
    (void)state;
    sb_matrix_free(&matrix);
    return 0;
}

static void check_text(struct sb_text *text, const char *wanted)
{
    if (strcmp(sb_text_get(text), wanted) != 0)
        fail_msg("\n%s\nis not\n%s", sb_text_get(text), wanted);
    sb_text_free(text);
}

static void a_row_is_a_case_and_the_worse_stage_shows(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_matrix_table(&matrix, 100, &text);
    check_text(&text, "       highp                        fp16\n"
                      "case   naive               robust   naive              robust\n"
                      "near: what is near\n"
                      "one    FAIL 44 > 0.5 /255  pass     FAIL inf > 4 /255  FAIL 5 > 4 "
                      "/255\n"
                      "two    pass                FAIL\n"
                      "far: what is far\n"
                      "three  n/a                 refused\n");
}

static void a_table_that_is_too_wide_goes_on_below(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_matrix_table(&matrix, 50, &text);
    check_text(&text, "       highp\n"
                      "case   naive               robust\n"
                      "near: what is near\n"
                      "one    FAIL 44 > 0.5 /255  pass\n"
                      "two    pass                FAIL\n"
                      "far: what is far\n"
                      "three  n/a                 refused\n"
                      "\n"
                      "       fp16\n"
                      "case   naive              robust\n"
                      "near: what is near\n"
                      "one    FAIL inf > 4 /255  FAIL 5 > 4 /255\n");
}

static void notes_and_reasons_are_said_once(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_matrix_notes(&matrix, 100, &text);
    check_text(&text, "one robust fp16 fragment: hm\n"
                      "two robust highp: does not compile\n"
                      "n/a, 2 cells: no room\n"
                      "  one, three\n");
    sb_matrix_notes(&matrix, 8, &text);
    check_contains(sb_text_get(&text), "  one,\n  three\n");
    sb_text_free(&text);
}

static void what_should_hold_and_does_not_is_listed(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_matrix_failures(&matrix, &text);
    check_text(&text, "one robust fp16 fragment: fail: absolute of colour: 5 > 4 /255 at "
                      "point 3: hm\n"
                      "two robust highp: fail: does not compile\n");
}

static void the_summary_counts_cells_and_forms(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_matrix_summary(&matrix, &text);
    check_text(
        &text,
        "two: naive passes wherever it was asked: floats are wide enough\n"
        "3 cases: 2 of 4 robust cells hold, 1 of 2 naive forms fail as they should, "
        "2 cells n/a\n");
}

static void a_breaking_point_is_that_of_the_stage_that_breaks_first(void **state)
{
    (void)state;
    struct sb_text text = {0};
    sb_matrix_breaking(&matrix, &text);
    check_text(&text, "");
    for (int i = 0; i < 6; i++)
        matrix.cell[i].broken = i != 3;
    matrix.cell[0].holds_to = matrix.cell[1].holds_to = matrix.cell[2].holds_to = 3e4;
    for (int i = 0; i < 3; i++)
        matrix.cell[i].to_the_end = true;
    matrix.cell[5].holds_to = 28999.7;
    sb_matrix_breaking(&matrix, &text);
    check_text(&text, "one: distance: highp to 30000 (all); fp16 naive not even at 1, "
                      "robust to 29000 units\n");
    matrix.cell[2].holds_to = 254.9;
    matrix.cell[2].to_the_end = false;
    sb_matrix_breaking(&matrix, &text);
    check_contains(sb_text_get(&text), "highp naive to 255, robust to 30000 (all); fp16");
    sb_text_free(&text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_row_is_a_case_and_the_worse_stage_shows, fill,
                                        empty),
        cmocka_unit_test_setup_teardown(a_table_that_is_too_wide_goes_on_below, fill,
                                        empty),
        cmocka_unit_test_setup_teardown(notes_and_reasons_are_said_once, fill, empty),
        cmocka_unit_test_setup_teardown(what_should_hold_and_does_not_is_listed, fill,
                                        empty),
        cmocka_unit_test_setup_teardown(the_summary_counts_cells_and_forms, fill, empty),
        cmocka_unit_test_setup_teardown(
            a_breaking_point_is_that_of_the_stage_that_breaks_first, fill, empty),
    };
    return run_tests(tests);
}
