// JUnit XML of a run and of a pair: against tests/junit.xsd by xmllint, where it is installed, and what
// services are to show of each outcome.
#include "cli_fixture.h"
#include "export_rows.h"

static char *wanted_case(const char *text, const char *name)
{
    char attribute[64];
    snprintf(attribute, sizeof attribute, " name=\"%s\"", name);
    const char *from = strstr(text, attribute);
    if (!from)
        fail_msg("no case %s in\n%s", name, text);
    const char *end = strstr(from, "</testcase>");
    assert_non_null(end);
    char *copy = strdup(from);
    copy[end - from] = '\0';
    return copy;
}

static void outcomes_are_elements_with_the_figures_in_their_text(void **state)
{
    (void)state;
    char *text = written("junit", &pair_export);
    check_contains(text, "<testsuites name=\"shadebench gate\" tests=\"2\" "
                         "failures=\"1\" errors=\"0\" skipped=\"0\">");
    char *failed = wanted_case(text, "point=8");
    check_contains(failed, "<failure message=\"regression: slower by more than 2 %\" "
                           "type=\"regression\">tolerance 2 %\n"
                           "p = 0.0001\n"
                           "ms a frame: 2.5 [2.4, 2.6], ratio: 1.25 [1.2, 1.3]");
    free(failed);
    free(text);

    text = written("junit", &run_export);
    check_contains(text, "tests=\"4\" failures=\"0\" errors=\"1\" skipped=\"1\">");
    char *broken = wanted_case(text, "point=9"), *late = wanted_case(text, "point=10");
    check_contains(broken, "<error message=\"compile_failed: 0:1: 'x' : "
                           "&quot;syntax&quot;&#9;error &amp; more\" "
                           "type=\"compile_failed\">line one\nline &lt;two&gt;");
    check_contains(late, "<skipped message=\"not_measured\"/>");
    check_contains(text, "<property name=\"renderer\" value=\"pipe | &quot;r&quot; "
                         "&lt;1&gt;\"/>");
    free(broken);
    free(late);
    free(text);
}

static void scenes_are_suites_however_their_rows_are_mixed(void **state)
{
    (void)state;
    char *text = written("junit", &run_export);
    check_contains(text, "<testsuite name=\"room\" tests=\"3\" failures=\"0\" "
                         "errors=\"1\" skipped=\"1\">");
    check_contains(text, "<testsuite name=\"plane\" tests=\"1\" failures=\"0\" "
                         "errors=\"0\" skipped=\"0\">");
    free(text);
}

static void check_schema(const char *text, int code)
{
    static struct answer answer;
    write_file("junit.xml", text);
    run_shell(&answer, "xmllint --noout --schema " SB_SOURCE_DIR
                       "/tests/junit.xsd @/junit.xml 2>&1");
    if (answer.code != code)
        fail_msg("xmllint: %d: %s", answer.code, answer.text);
}

static void both_hold_to_the_schema(void **state)
{
    (void)state;
    static struct answer answer;
    run_shell(&answer, "command -v xmllint");
    if (answer.code != 0) {
        print_message("no xmllint here: apt-get install libxml2-utils\n");
        skip();
    }
    char *run = written("junit", &run_export), *pair = written("junit", &pair_export);
    check_schema(run, 0);
    check_schema(pair, 0);
    free(run);
    free(pair);
    // A schema that took anything would not tell. 3: not valid.
    check_schema("<testsuites name=\"x\" tests=\"0\"/>", 3);
    check_schema("<testsuites name=\"x\" tests=\"0\" failures=\"0\" errors=\"0\" "
                 "skipped=\"0\"><testcase name=\"y\"/></testsuites>",
                 3);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outcomes_are_elements_with_the_figures_in_their_text),
        cmocka_unit_test(scenes_are_suites_however_their_rows_are_mixed),
        cmocka_unit_test(both_hold_to_the_schema),
    };
    return end_tests(run_tests(tests));
}
