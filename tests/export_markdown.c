// The table of a pull request, byte for byte.
#include "export_rows.h"

static void what_did_not_pass_comes_first_and_the_rest_is_folded(void **state)
{
    (void)state;
    char *text = written("markdown", &pair_export);
    check_text(
        text,
        "### shadebench gate\n\n"
        "**1 failed**, 1 passed\n\n"
        "| variant | base | head | ratio [95 %] | verdict |\n"
        "|:--|--:|--:|--:|:--|\n"
        "| room/point=8 | 2.000 ms ± 5.0 % | 2.500 ms ± 4.0 % | 1.250 [1.200, 1.300] | "
        "regression: slower by more than 2 % |\n\n"
        "<details><summary>1 passed</summary>\n\n"
        "| variant | base | head | ratio [95 %] | verdict |\n"
        "|:--|--:|--:|--:|:--|\n"
        "| room/point=1 | 1.000 ms | 1.000 ms | 1.000 [0.990, 1.010] | unchanged |\n\n"
        "</details>\n");
    free(text);
}

static void counts_stand_where_times_would(void **state)
{
    (void)state;
    char *text = written("markdown", &untimed_export);
    check_contains(text, "| room/point=8 | 1000001 instructions | 1050000 instructions | "
                         "1.050 [1.040, 1.060] | pass |\n");
    check_contains(text, "| room/point=1 |  |  |  | skipped |\n");
    free(text);
}

static void no_text_breaks_the_table_or_marks_itself_up(void **state)
{
    (void)state;
    char *text = written("markdown", &run_export);
    check_text(
        text,
        "### shadebench run lights\n\n"
        "renderer: pipe \\| \"r\" &lt;1&gt; · seed: 1\n\n"
        "**1 not valid**, **1 not decided**, 2 passed\n\n"
        "| variant | time a frame | ratio [95 %] | status |\n"
        "|:--|--:|--:|:--|\n"
        "| room/point=9 |  |  | compile\\_failed: 0:1: 'x' : \"syntax\" error &amp; more "
        "|\n"
        "| room/point=10 |  |  | not\\_measured |\n\n"
        "<details><summary>2 passed</summary>\n\n"
        "| variant | time a frame | ratio [95 %] | status |\n"
        "|:--|--:|--:|:--|\n"
        "| room/point=8,stage=fragment | 2.500 ms ± 40.0 % | 1.250 [1.125, 1.500] | ok "
        "|\n"
        "| plane/form=\"a, b\",&lt;c&gt;&amp;d\\|e f/g é\xEF\xBF\xBD | 1.500 ms |  | "
        "not\\_fragment\\_bound: valid, \"but\" &lt;so&gt; |\n\n"
        "</details>\n");
    free(text);
}

static void where_nothing_passed_nothing_is_folded(void **state)
{
    (void)state;
    const struct sb_export export = {
        .name = "n", .row = &pair_rows[BASE], .row_count = HEAD - BASE + 1};
    char *text = written("markdown", &export);
    check_contains(text, "**1 failed**, 0 passed\n\n| variant |");
    assert_null(strstr(text, "<details>"));
    free(text);
}

static void nobody_is_called_and_nothing_linked(void **state)
{
    (void)state;
    const struct sb_export_row row = {.scene = "s",
                                      .variant = "v",
                                      .outcome = SB_EXPORT_FAILED,
                                      .message = "@team [x](y) #1 *b* ~~c~~ `d` \\ \n_",
                                      .frame_ns = NONE,
                                      .ratio = NONE};
    char *text = written("markdown",
                         &(struct sb_export){.name = "n", .row = &row, .row_count = 1});
    check_contains(text, "| s/v |  |  | @&#8203;team \\[x\\](y) \\#1 \\*b\\* "
                         "\\~\\~c\\~\\~ \\`d\\` \\\\  \\_ |\n");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_did_not_pass_comes_first_and_the_rest_is_folded),
        cmocka_unit_test(counts_stand_where_times_would),
        cmocka_unit_test(no_text_breaks_the_table_or_marks_itself_up),
        cmocka_unit_test(where_nothing_passed_nothing_is_folded),
        cmocka_unit_test(nobody_is_called_and_nothing_linked),
    };
    return run_tests(tests);
}
