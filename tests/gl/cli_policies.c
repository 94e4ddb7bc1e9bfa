// Policies and ablations on a real context, through the program.
#include "cli_gl.h"

#include "results/csv.h"

static struct sb_csv csv;

static void read_summary(const char *name)
{
    char path[64];
    snprintf(path, sizeof path, "%s/summary.csv", name);
    read_csv(path, &csv);
}

static const char *cell(int line, const char *column)
{
    return csv_cell(&csv, line, column);
}

// Small pictures and few rounds; on a busy machine no timer may be believed, and nothing is asked.
static bool run(const char *words)
{
    static struct answer answer;
    char line[512];
    snprintf(line, sizeof line,
             "run -q %s --rounds 6 --first-look 6 --set width=48 --set height=48 %s",
             platform, words);
    run_timed(&answer, line);
    if (answer.code != 0 && !no_timer(&answer))
        fail_msg("%s\n%s", line, answer.text);
    return answer.code == 0;
}

static void each_policy_is_held_against_the_faster_uber_program(void **state)
{
    (void)state;
    if (!run("--scene mixed "
             "--set point=2 --sweep loop=dynamic,padded --cross specialise=uber,object "
             "--payback -o @/policies"))
        skip();
    read_summary("policies");
    assert_int_equal(csv.row_count, 5);
    const char *against = cell(1, "against");
    for (int i = 1; i < 5; i++) {
        assert_string_equal(cell(i, "against"), against);
        check_contains(cell(i, "against"), "specialise=uber");
        assert_true(atof(cell(i, "against_ratio")) > 0);
        const bool object = strstr(cell(i, "variant"), "object") != NULL;
        assert_true(object ? atoi(cell(i, "programs")) >= 2
                           : atoi(cell(i, "programs")) == 1);
        assert_int_equal(atoi(cell(i, "switches")), atoi(cell(i, "programs")) - 1);
    }
    sb_csv_free(&csv);
}

static void a_light_that_a_policy_leaves_out_everywhere_is_not_dead(void **state)
{
    (void)state;
    if (!run("--scene spheres "
             "--set point=2 --set specialise=scene --threshold 1 -o @/left_out"))
        skip();
    read_summary("left_out");
    assert_string_not_equal(cell(1, "status"), "dead_light");
    sb_csv_free(&csv);
}

static void an_ablation_saves_time_or_not_but_shows_its_error(void **state)
{
    (void)state;
    if (!run("--scene mixed "
             "--set point=2 --ablate -o @/ablation"))
        skip();
    read_summary("ablation");
    const double whole = atof(cell(1, "flip_mean"));
    for (int i = 2; i < csv.row_count; i++) {
        assert_string_equal(cell(i, "against"), cell(1, "variant"));
        assert_string_equal(cell(i, "err_arithmetic"), ""); // only the sum is known
        if (!strstr(cell(i, "variant"), "renormalise"))
            assert_true(atof(cell(i, "flip_mean")) > 1.1 * whole);
    }
    sb_csv_free(&csv);
}

int main(void)
{
    begin_gl_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_policy_is_held_against_the_faster_uber_program),
        cmocka_unit_test(a_light_that_a_policy_leaves_out_everywhere_is_not_dead),
        cmocka_unit_test(an_ablation_saves_time_or_not_but_shows_its_error),
    };
    return end_tests(run_tests(tests));
}
