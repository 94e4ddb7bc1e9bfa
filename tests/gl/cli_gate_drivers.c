// shadebench gate on a real driver: what must pass, what must not, and what it says of it. By CPU time,
// which is what a gate on a CPU driver takes; the differences that must be found are far over the
// tolerance.
#include "cli_gl.h"

#define SMALL " -q --set point=2 --set width=64 --set height=64 --budget 8 "

static struct answer answer;
static struct sb_csv csv;

// A copy of the shaders as @/NAME, with a line of sed for one of its files.
static void copy_shaders(const char *name, const char *sed, const char *file)
{
    char line[1024];
    snprintf(line, sizeof line,
             "cp -r '" SB_SOURCE_DIR "/shaders' @/%s && cd @/%s && cp %s before && "
             "sed -i '%s' %s && ! cmp -s before %s",
             name, name, file, sed, file, file);
    check_shell(line, 0, "");
}

// Holds the copy against the shaders as they are; gate.csv is read.
static void hold(const char *name, const char *options)
{
    char line[1024], path[128];
    static int number;
    snprintf(line, sizeof line,
             "gate %s" SMALL "--base '" SB_SOURCE_DIR
             "/shaders' --head @/%s -o @/out%d %s",
             platform, name, ++number, options);
    run_program(&answer, line);
    snprintf(path, sizeof path, "out%d/gate.csv", number);
    read_csv(path, &csv);
    if (csv.row_count < 2)
        fail_msg("%s: exit code %d: %s", line, answer.code, answer.text);
}

#define check_gate(code, line, column, value)                                            \
    check_gate_at(code, line, column, value, __LINE__)
static void check_gate_at(int code, int line, const char *column, const char *value,
                          int at)
{
    if (answer.code != code || strcmp(csv_cell(&csv, line, column), value) != 0)
        fail_msg("line %d: %s of row %d is %s, not %s; exit code %d, not %d: %s", at,
                 column, line, csv_cell(&csv, line, column), value, answer.code, code,
                 answer.text);
}

static void a_comment_does_not_alarm(void **state)
{
    (void)state;
    copy_shaders("comment", "$a // a comment", "shade.frag");
    hold("comment", "--cross stage=fragment,vertex");
    for (int row = 1; row <= 2; row++) {
        check_gate(0, row, "status", "ok");
        check_gate(0, row, "picture", "equal");
        assert_string_not_equal(csv_cell(&csv, row, "base_source"),
                                csv_cell(&csv, row, "head_source"));
        check_close(atof(csv_cell(&csv, row, "ratio")), 1, 0.1);
    }
    sb_csv_free(&csv);
}

static void a_wrong_formula_is_a_worse_picture_with_its_place_and_term(void **state)
{
    (void)state;
    copy_shaders("wrong",
                 "s/factor = attenuation(light, length/factor = attenuation(light, 0.5 * "
                 "length/",
                 "lights/point.glsl");
    hold("wrong", "--cross stage=fragment,vertex");
    for (int row = 1; row <= 2; row++) {
        const char *note = csv_cell(&csv, row, "note");
        check_gate(1, row, "status", "worse_picture");
        check_gate(1, row, "status_of", "head");
        check_gate(1, row, "verdict", "invalid");
        check_gate(1, row, "picture", "worse");
        check_gate(1, row, "pairs", ""); // no time is worth comparing
        check_contains(note, " at (");
        check_contains(note, ", term attenuation");
        assert_true(atof(csv_cell(&csv, row, "head_max_err")) >
                    atof(csv_cell(&csv, row, "base_max_err")) + 0.05);
    }
    check_contains(answer.text, "head: worse_picture");
    sb_csv_free(&csv);
}

// A formula that is right, and rounds otherwise, is no worse. It has a time, then.
static void another_way_to_the_same_picture_is_no_worse(void **state)
{
    (void)state;
    copy_shaders("other",
                 "s/o_color = vec4(shade.diffuse, 1.0)/"
                 "o_color = vec4(shade.diffuse * 1.0005, 1.0)/",
                 "shade.frag");
    hold("other", "");
    check_gate(0, 1, "status", "ok");
    check_gate(0, 1, "picture", "no_worse");
    assert_true(atoi(csv_cell(&csv, 1, "pairs")) >= 15);
    sb_csv_free(&csv);
}

#define WASTE                                                                            \
    "s/^    PROBE_PIXEL_OUT/    highp float waste = v_uv.x;\\n    for (int i = 0; i < "  \
    "100; i++)\\n        waste = waste * 0.999 + 0.0001;\\n    if (waste > 1e6)\\n"      \
    "        o_color.r = 0.0;\\n    PROBE_PIXEL_OUT/"

static void work_that_changes_no_pixel_is_a_regression(void **state)
{
    (void)state;
    static const char *const ways[] = {"", "--in-process",
                                       "--metric wall --tolerance 5%"};
    copy_shaders("waste", WASTE, "shade.frag");
    for (int way = 0; way < 3; way++) {
        hold("waste", ways[way]);
        check_gate(1, 1, "verdict", "regression");
        check_gate(1, 1, "picture", "equal");
        assert_true(atof(csv_cell(&csv, 1, "ratio_lo")) > 1.2);
        assert_true(atof(csv_cell(&csv, 1, "confirm_ratio")) > 1.2);
        sb_csv_free(&csv);
    }
    // Turned round it is an improvement.
    check_shell("mv @/waste @/base-waste", 0, "");
    char line[512];
    snprintf(line, sizeof line,
             "gate %s" SMALL "--base @/base-waste --head '" SB_SOURCE_DIR
             "/shaders' -o @/back",
             platform);
    check_answer(line, 0, "1 improved");
}

static void a_picture_that_is_not_a_number_is_not_timed(void **state)
{
    (void)state;
    copy_shaders("nan",
                 "s/vec4(shade.diffuse, 1.0)/vec4(shade.diffuse + sqrt(-1.0 - "
                 "v_uv.x * v_uv.x), 1.0)/",
                 "shade.frag");
    hold("nan", "--set target=rgba16f");
    check_gate(3, 1, "status", "non_finite");
    check_gate(3, 1, "status_of", "head");
    check_contains(csv_cell(&csv, 1, "note"),
                   "values of the picture are NaN or infinite");
    sb_csv_free(&csv);
    // Eight bits have no NaN: the picture is then another one, or black.
    hold("nan", "");
    assert_true(answer.code == 1 || answer.code == 3);
    sb_csv_free(&csv);
}

static void what_does_not_compile_is_told_in_the_drivers_words(void **state)
{
    (void)state;
    copy_shaders("broken", "s/^    PROBE_PIXEL_OUT/    o_color.r = nowhere;/",
                 "shade.frag");
    hold("broken", "");
    check_gate(3, 1, "status", "compile_failed");
    check_contains(csv_cell(&csv, 1, "note"), "nowhere");
    check_contains(csv_cell(&csv, 1, "note"), "shade.frag:");
    sb_csv_free(&csv);
}

// In the scene no normal is zero, so the pictures are equal; the hard case tells.
static void a_guard_that_is_gone_is_a_lost_hard_case(void **state)
{
    (void)state;
    copy_shaders("unguarded",
                 "s/v2 > 0.0 ? v \\* inversesqrt(v2) : v;/v * inversesqrt(v2);/",
                 "unit.glsl");
    hold("unguarded", "--cases zero-normal,light-order --write junit=@/lost.xml");
    check_gate(1, 1, "picture", "equal");
    check_contains(answer.text,
                   "hard case zero-normal fragment highp: base passes with ");
    check_contains(answer.text, " that base passes and head does not");
    assert_null(strstr(answer.text, "hard case light-order"));
    sb_csv_free(&csv);
    char *junit = read_file("lost.xml");
    check_contains(junit,
                   "<testcase classname=\"hard cases\" name=\"zero-normal fragment "
                   "highp\"");
    check_contains(junit, "<failure message=\"fail: base passes with ");
    free(junit);
}

// What everybody knows, said of two drivers in two processes.
static void softpipe_is_slower_than_llvmpipe(void **state)
{
    (void)state;
    char line[512];
    snprintf(line, sizeof line,
             "gate %s -q --set point=2 --set width=32 --set height=32 --budget 8 "
             "--base-env GALLIUM_DRIVER=llvmpipe --head-env GALLIUM_DRIVER=softpipe -o "
             "@/drivers",
             platform);
    run_program(&answer, line);
    check_contains(answer.text, "driver of base: llvmpipe");
    check_contains(answer.text, "driver of head: softpipe");
    read_csv("drivers/gate.csv", &csv);
    check_gate(1, 1, "verdict", "regression");
    assert_true(atof(csv_cell(&csv, 1, "ratio")) > 3);
    // Twelve processes a side, or fewer do not decide.
    assert_true(atoi(csv_cell(&csv, 1, "pairs")) >= 45);
    sb_csv_free(&csv);
}

static void a_selftest_tells_the_bias_of_this_machine(void **state)
{
    (void)state;
    char line[512];
    snprintf(line, sizeof line,
             "gate %s" SMALL "--selftest --tolerance 30%% -o @/selftest", platform);
    check_answer(line, 0, "it can be used here");
}

int main(void)
{
    begin_gl_tests();
    unsetenv("GITHUB_STEP_SUMMARY");
    unsetenv("LP_NUM_THREADS");
    if (!strstr(caps.renderer, "llvmpipe")) {
        print_message("skipped: by CPU time, which says nothing of %s\n", caps.renderer);
        return end_tests(77);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_comment_does_not_alarm),
        cmocka_unit_test(a_wrong_formula_is_a_worse_picture_with_its_place_and_term),
        cmocka_unit_test(another_way_to_the_same_picture_is_no_worse),
        cmocka_unit_test(work_that_changes_no_pixel_is_a_regression),
        cmocka_unit_test(a_picture_that_is_not_a_number_is_not_timed),
        cmocka_unit_test(what_does_not_compile_is_told_in_the_drivers_words),
        cmocka_unit_test(a_guard_that_is_gone_is_a_lost_hard_case),
        cmocka_unit_test(softpipe_is_slower_than_llvmpipe),
        cmocka_unit_test(a_selftest_tells_the_bias_of_this_machine),
    };
    return end_tests(run_tests(tests));
}
