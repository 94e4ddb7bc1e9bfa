#include "test.h"

#include "glsl/glsl.h"

// Lines 1 and 2 are generated, 3 to 5 are light.glsl:7 to 9, 6 is main.frag:2.
static struct sb_glsl_line lines[] = {{-1, 1}, {-1, 2}, {0, 7}, {0, 8}, {0, 9}, {1, 2}};
static const char *names[] = {"light.glsl", "main.frag"};
static const struct sb_glsl_source source = {
    .line = lines, .line_count = 6, .file_name = names, .file_count = 2};

static void check_log(const char *log, const char *expected)
{
    struct sb_text text = {0};
    sb_glsl_explain(&source, log, &text);
    assert_string_equal(sb_text_get(&text), expected);
    sb_text_free(&text);
}

static void the_forms_of_the_known_compilers_are_mapped(void **state)
{
    (void)state;
    check_log("0:4(12): error: `foo' undeclared\n", // Mesa
              "light.glsl:8:12: error: `foo' undeclared\n");
    check_log("0(4) : error C1503: undefined variable \"foo\"\n", // NVIDIA
              "light.glsl:8: error C1503: undefined variable \"foo\"\n");
    check_log("ERROR: 0:4: error(#143) Undeclared identifier: foo\n", // AMD
              "ERROR: light.glsl:8: error(#143) Undeclared identifier: foo\n");
    check_log("ERROR: 0:4: Use of undeclared identifier 'foo'\n", // Apple
              "ERROR: light.glsl:8: Use of undeclared identifier 'foo'\n");
    check_log("ERROR: 0:4: 'foo' : undeclared identifier \n", // glslang
              "ERROR: light.glsl:8: 'foo' : undeclared identifier \n");
    check_log("WARNING: 0:4: 'foo' : unused", "WARNING: light.glsl:8: 'foo' : unused");
    check_log("0:4: L0002: Undeclared variable 'foo'", // Mali
              "light.glsl:8: L0002: Undeclared variable 'foo'");
}

static void every_message_of_a_log_is_mapped_to_its_own_file(void **state)
{
    (void)state;
    check_log("0:3(1): warning: a\n0:6(2): error: b\n\n0:2(9): error: c",
              "light.glsl:7:1: warning: a\nmain.frag:2:2: error: b\n\n"
              "(generated):2:9: error: c");
}

static void an_end_that_comes_too_soon_is_on_the_last_line(void **state)
{
    (void)state;
    check_log("0:7(1): error: unexpected end", "main.frag:2:1: error: unexpected end");
}

static void other_lines_stay_as_they_are(void **state)
{
    (void)state;
    static const char *const same[] = {
        "",
        "\n",
        "ERROR: 2 compilation errors.  No code generated.\n",
        "Fragment info\n-------------\n",
        "0:8(1): error: no such line",
        "0:0(1): error: no such line",
        "1:4(1): error: another string",
        "0:4(1 error: half a form",
        "0:99999999999999999999: error: absurd",
        "0x4: error",
        "error: linking with 0:4: in the middle",
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        check_log(same[i], same[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_forms_of_the_known_compilers_are_mapped),
        cmocka_unit_test(every_message_of_a_log_is_mapped_to_its_own_file),
        cmocka_unit_test(an_end_that_comes_too_soon_is_on_the_last_line),
        cmocka_unit_test(other_lines_stay_as_they_are),
    };
    return run_tests(tests);
}
