// The bad-input tour: whatever is wrong gets one clear line and the right exit code.
#include "cli_fixture.h"

// Runs a suite of this text on the null runner.
static void check_suite(const char *text, int code, const char *part)
{
    char arguments[512];
    snprintf(arguments, sizeof arguments, "run --context null -q -o %s/out-%d %s",
             test_dir, rand(), write_file("suite.yaml", text));
    check_answer(arguments, code, part);
}

static void unknown_words_are_answered_with_the_nearest_and_the_valid(void **state)
{
    (void)state;
    check_answer("rnu", 2, "did you mean \"run\"?");
    check_answer("run --swep point=1", 2, "did you mean \"--sweep\"?");
    check_answer("run ligths", 2, "did you mean \"lights\"?");
    check_answer("run --context null --set stage=vretex", 2, "did you mean \"vertex\"?");
    check_answer("run --context null --set vretex=1", 2, "unknown axis \"vretex\"");
    check_answer("run --context nul", 2, "null");
    check_answer("run --context null --scene speher", 2, "sphere");
    check_answer("list axises", 2, "did you mean \"axes\"? valid: suites");
    check_answer("run --context null --timer elapsd -o @/timer", 2, "unknown timer");
    check_answer("show point=4,stag=vertex", 2, "stag");
    check_answer("run --preset delfi --context null", 2, "delfi");
}

static void wrong_values_say_what_is_valid(void **state)
{
    (void)state;
    check_answer("run --context null --set point=1000000000", 2, "0 to 256");
    check_answer("run --context null --set point=2.5", 2, "whole numbers");
    check_answer("run --context null --set point=nan", 2, "not a number");
    check_answer("run --context null --set width=0", 2, "1 to 16384");
    check_answer("run --context null --sweep point=8..0", 2, "8..0");
    check_answer("run --context null --set point", 2, "AXIS=VALUE");
    check_answer("run --context null --rounds many --set point=1", 2, "many");
    check_answer("run --context null --device x --set point=1", 2, "--device x");
    check_answer("run --budget", 2, "wants a value");
    check_answer("run --quiet=yes", 2, "takes no value");
    check_answer("run a b", 2, "\"b\" is one too many");
}

static void a_wrong_suite_file_names_file_line_and_column(void **state)
{
    (void)state;
    check_suite("", 2, "suite.yaml");
    check_suite("suite: x\nbase: {piont: 4}\n", 2, "suite.yaml:2:8");
    check_suite("suite: x\nbase: {point: [4}\n", 2, "suite.yaml:2");
    check_suite("suite: x\nsuite: y\n", 2, "suite.yaml:2:1");
    check_suite("suite: x\nbase: {point: 1, point: 2}\n", 2, "suite.yaml:2");
    check_suite("suite: x\nbase: &a {point: *a}\n", 2, "suite.yaml:2");
    check_suite("suite: x\ncolour: red\n", 2, "suite.yaml:2:1");
    check_suite("suite: x\nsweep: {point: many}\n", 2, "suite.yaml:2");
    check_suite("suite: x\n---\nsuite: y\n", 2, "suite.yaml");
    check_suite("just words\n", 2, "suite.yaml:1");
    check_suite("suite: x\nmeasure: {roundz: 3}\n", 2, "roundz");
    check_answer("run /nonexistent/suite.yaml", 2,
                 "/nonexistent/suite.yaml: No such file");
    check_answer("run /tmp/", 2, "is a directory");
}

static void every_message_is_one_line(void **state)
{
    (void)state;
    static const char *const bad[] = {"run --set point=x",
                                      "run nosuch",
                                      "frobnicate",
                                      "run --resume /nonexistent",
                                      "run --data /nonexistent",
                                      "show point=x",
                                      "list x",
                                      "run --frob"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        static struct answer answer;
        run_program(&answer, bad[i]);
        assert_int_equal(answer.code, 2);
        if (count_lines(answer.text) != 1 ||
            strncmp(answer.text, "shadebench: ", 12) != 0)
            fail_msg("%s: %s", bad[i], answer.text);
    }
}

static void folders_that_cannot_be_read_or_written_are_named(void **state)
{
    (void)state;
    char arguments[512];
    const char *file = write_file("plain", "x");
    snprintf(arguments, sizeof arguments,
             "run --context null --set point=1 -q -o %s/below", file);
    check_answer(arguments, 2, "Not a directory");
    snprintf(arguments, sizeof arguments,
             "run --context null --set point=1 -q --shaders %s/none -o %s/shaders-out",
             test_dir, test_dir);
    check_answer(arguments, 2, "none");
    check_answer("run --context null --set point=1 -q -o /proc/shadebench", 2,
                 "/proc/shadebench");
}

static void a_results_folder_is_never_overwritten(void **state)
{
    (void)state;
    static const char again[] =
        "run --context null --set point=1 -q --rounds 10 --first-look 10 -o @/once";
    check_answer(again, 0, "results:");
    char *before = read_file("once/samples.csv");
    check_answer(again, 2, "--resume");
    char *after = read_file("once/samples.csv");
    assert_string_equal(before, after);
    free(before);
    free(after);
}

// What a newcomer types instead of --set is answered with the way to say it.
static void misspelt_ways_to_set_an_axis_are_answered_with_the_right_one(void **state)
{
    (void)state;
    check_answer("run --point 4", 2, "--set point=4");
    check_answer("run --point=4", 2, "--set point=4");
    check_answer("run --point", 2, "--set point=VALUE");
    check_answer("run --point --quiet", 2, "--set point=VALUE");
    check_answer("show --stage vertex", 2, "--set stage=vertex");
    check_answer("run point=4", 2, "--set point=4");
    check_answer("run lights point=4,stage=vertex", 2, "set with --set point=4\n");
    check_answer("run --set point 4", 2, "--set point=4");
    check_answer("show vertex", 2, "--set stage=vertex");
    check_answer("show point=4 vertex", 2, "--set stage=vertex");
    check_answer("probe egl", 2, "--context egl");
    check_answer("run context=egl", 2, "--context egl");
    check_answer("probe --point 4", 2, "valid: --timer"); // probe draws no variant
}

static void a_word_of_another_kind_is_answered_with_its_place(void **state)
{
    (void)state;
    check_answer("lights", 2, "\"lights\" is a suite: shadebench run lights");
    check_answer("run light", 2, "did you mean \"lights\"?");
    check_answer("list preset", 2, "did you mean \"presets\"?");
    check_answer("run --shaders @/none", 2, "/none: there is no such folder");
    check_answer("help rnu", 2, "did you mean \"run\"?");
    check_answer("help run", 0, "--first-look");
    // A suite whose name is the value of an axis, too, is the suite.
    check_answer("show lights", 0, "variants;");
}

static void glsl_of_the_other_api_is_refused_with_the_versions_that_go(void **state)
{
    (void)state;
    check_answer("run --context null --glsl 300es -q -o @/es", 2, "valid here: 330 450");
    check_answer("run --context null --api gles --glsl 330 -q -o @/gl", 2,
                 "valid here: 100 300es 310es");
}

static void help_names_every_option_and_setting(void **state)
{
    (void)state;
    check_answer("run --help", 0, "--first-look");
    check_answer("run --help", 0, "--context");
    check_answer("--help", 0, "probe");
    check_answer("", 2, "usage:");
    check_answer("--version", 0, "shadebench ");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unknown_words_are_answered_with_the_nearest_and_the_valid),
        cmocka_unit_test(wrong_values_say_what_is_valid),
        cmocka_unit_test(a_wrong_suite_file_names_file_line_and_column),
        cmocka_unit_test(every_message_is_one_line),
        cmocka_unit_test(folders_that_cannot_be_read_or_written_are_named),
        cmocka_unit_test(a_results_folder_is_never_overwritten),
        cmocka_unit_test(misspelt_ways_to_set_an_axis_are_answered_with_the_right_one),
        cmocka_unit_test(a_word_of_another_kind_is_answered_with_its_place),
        cmocka_unit_test(glsl_of_the_other_api_is_refused_with_the_versions_that_go),
        cmocka_unit_test(help_names_every_option_and_setting),
    };
    return end_tests(run_tests(tests));
}
