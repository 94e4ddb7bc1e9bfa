// `shadebench verify` of two hard cases on a real driver: the naive forms fail where the catalogue
// says, the robust ones hold, and the files say the same.
#include "cli_gl.h"

// The half precision that is asked where none is named: the driver's own, or the emulated one.
static const char *half;

static void the_robust_forms_hold_and_the_naive_ones_fail(void **state)
{
    (void)state;
    static struct answer answer;
    char line[256];
    snprintf(line, sizeof line,
             "verify light-on-surface dist-overflow16 --breaking -q -o @/two %s",
             platform);
    run_program(&answer, line);
    if (answer.code != 0)
        fail_msg("exit code %d: %s", answer.code, answer.text);
    check_contains(answer.text,
                   "2 cases: 8 of 8 robust cells hold, 2 of 2 naive forms fail "
                   "as they should");
    half = strstr(answer.text, "mediump") ? "mediump" : "fp16";
    // 256^2 = 65536 is the first square that binary16 cannot hold (65504 is its largest number).
    const char *reach = strstr(answer.text, "naive to ");
    assert_non_null(reach);
    check_close(atof(reach + strlen("naive to ")), 256, 1);
    check_contains(answer.text, "dist-overflow16: distance: highp to 30000 (all); ");
}

static void rows_and_reports_say_the_same(void **state)
{
    (void)state;
    struct sb_csv csv;
    int failed = 0;
    read_csv("two/cases.csv", &csv);
    assert_int_equal(csv.row_count, 1 + 16);
    for (int i = 1; i < csv.row_count; i++) {
        const bool fails = strcmp(csv_cell(&csv, i, "verdict"), "fail") == 0;
        const bool naive = strcmp(csv_cell(&csv, i, "form"), "naive") == 0;
        const bool overflow = strcmp(csv_cell(&csv, i, "case"), "dist-overflow16") == 0;
        const bool narrow = strcmp(csv_cell(&csv, i, "precision"), half) == 0;
        // No number is too large for floats there, and 0/0 is none in any precision.
        assert_int_equal(fails, naive && (narrow || !overflow));
        failed += fails;
        assert_string_equal(csv_cell(&csv, i, "renderer"), caps.renderer);
        assert_true((*csv_cell(&csv, i, "holds_to") != '\0') == overflow);
        if (fails)
            assert_string_equal(csv_cell(&csv, i, "figure"), "finite");
    }
    assert_int_equal(failed, 6);
    sb_csv_free(&csv);
    char *junit = read_file("two/junit.xml");
    check_contains(junit, "<testsuites name=\"shadebench verify\" tests=\"16\" "
                          "failures=\"0\" errors=\"0\" skipped=\"0\">");
    check_contains(junit, "<system-out>fail: finite: ");
    free(junit);
}

// Where a guard is taken away the robust form is as bad, and the exit code says so.
static void a_guard_that_is_gone_fails(void **state)
{
    (void)state;
    char line[512];
    check_shell("cp -r '" SB_SOURCE_DIR "/shaders' @/wrong && "
                "sed -i 's/return d2 > 0.0 ? d [*] inversesqrt(d2) : d;/return d * "
                "inversesqrt(d2);/' @/wrong/unit.glsl && "
                "! cmp -s '" SB_SOURCE_DIR "/shaders/unit.glsl' @/wrong/unit.glsl",
                0, "");
    snprintf(
        line, sizeof line,
        "verify light-on-surface --precision highp -q --shaders @/wrong -o @/gone %s",
        platform);
    check_answer(line, 1, "light-on-surface robust highp fragment: fail: finite: ");
}

int main(void)
{
    begin_gl_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_robust_forms_hold_and_the_naive_ones_fail),
        cmocka_unit_test(rows_and_reports_say_the_same),
        cmocka_unit_test(a_guard_that_is_gone_fails),
    };
    return end_tests(run_tests(tests));
}
