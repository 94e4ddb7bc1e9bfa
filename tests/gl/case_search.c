// The search finds what naive forms are known for and shrinks it; breaking points are where closed
// forms put them.
#include "cases/breaking.h"
#include "cases/search.h"
#include "case_world.h"

static void the_search_finds_what_naive_forms_are_known_for(void **state)
{
    (void)state;
    struct sb_error err = {0};
    const struct sb_case_env env = case_env(NULL);
    const struct sb_search_params params = {.env = &env,
                                            .seconds = 20,
                                            .seed = 1,
                                            .form = SB_CASE_NAIVE,
                                            .precision = SB_CASE_HIGHP};
    struct sb_findings findings = {0};
    if (!sb_search(&params, &findings, &err))
        fail_msg("%s", err.text);
    printf("%d found among %lld points\n", findings.count, (long long)findings.asked);
    for (int i = 0; i < findings.count; i++) {
        struct sb_text text = {0};
        sb_found_text(&findings.row[i], &params, i, &text);
        puts(sb_text_get(&text));
        sb_text_free(&text);
    }
    assert_true(findings.count > 0);
    sb_findings_free(&findings);
}

static void robust(void **state)
{
    (void)state;
    struct sb_error err = {0};
    const struct sb_case_env env = case_env(NULL);
    const struct sb_search_params params = {.env = &env,
                                            .seconds = 20,
                                            .seed = 1,
                                            .form = SB_CASE_ROBUST,
                                            .precision = getenv("HALF") ? SB_CASE_HALF
                                                                        : SB_CASE_HIGHP};
    struct sb_findings findings = {0};
    if (!sb_search(&params, &findings, &err))
        fail_msg("%s", err.text);
    printf("%d found among %lld points\n", findings.count, (long long)findings.asked);
    for (int i = 0; i < findings.count; i++) {
        struct sb_text text = {0};
        sb_found_text(&findings.row[i], &params, i, &text);
        puts(sb_text_get(&text));
        sb_text_free(&text);
    }
    sb_findings_free(&findings);
}

// The square of a distance leaves half precision at 65520: at 255.97, and 255.875 is the last
// number below.
static void a_distance_breaks_half_precision_at_256(void **state)
{
    (void)state;
    struct sb_error err = {0};
    const struct sb_case_env env = case_env(NULL);
    const struct sb_case *it = sb_case_expect("dist-overflow16", NULL, &err);
    struct sb_breaking naive, robust_one;
    if (!sb_case_break(&env, it, SB_CASE_NAIVE, case_half(&env), false, &naive, &err) ||
        !sb_case_break(&env, it, SB_CASE_ROBUST, case_half(&env), false, &robust_one,
                       &err))
        fail_msg("%s", err.text);
    printf("naive to %g, robust to %g\n", naive.holds_to, robust_one.holds_to);
    assert_true(naive.holds_to > 200 && naive.holds_to < 256);
    assert_true(robust_one.to_the_end);
    sb_text_free(&naive.outcome.note);
    sb_text_free(&robust_one.outcome.note);
}

int main(void)
{
    open_case_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_distance_breaks_half_precision_at_256),
        cmocka_unit_test(the_search_finds_what_naive_forms_are_known_for),
        cmocka_unit_test(robust),
    };
    const int code = cmocka_run_group_tests(tests, NULL, NULL);
    sb_driver_close(&case_driver);
    return code;
}
