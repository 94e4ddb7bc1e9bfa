// The search finds what naive forms are known for and shrinks it; breaking points are where closed
// forms put them.
#include "cases/breaking.h"
#include "cases/knobs.h"
#include "cases/search.h"
#include "case_world.h"

static void search(enum sb_case_form form, double seconds, struct sb_findings *findings)
{
    struct sb_error err = {0};
    const struct sb_search_params params = {.env = &case_env,
                                            .seconds = seconds,
                                            .seed = 1,
                                            .form = form,
                                            .precision = SB_CASE_HIGHP};
    *findings = (struct sb_findings){0};
    if (!sb_search(&params, findings, &err))
        fail_msg("%s", err.text);
    assert_true(findings->asked > 0);
}

// Floats of a point and its light that are not those of a plain one.
static int count_changes(const struct sb_points *points)
{
    struct sb_points plain = {.lights = points->lights};
    memcpy(plain.type, points->type, sizeof plain.type);
    sb_points_add(&plain);
    int changes = 0;
    for (int k = 0; k < sb_knob_count; k++)
        for (int c = 0; c < sb_knobs[k].components; c++)
            changes += *sb_knob_of(points, 0, &sb_knobs[k], c) !=
                       *sb_knob_of(&plain, 0, &sb_knobs[k], c);
    sb_points_free(&plain);
    return changes;
}

// The first look is a point light: a zero normal, or a light or an eye on the surface, each of
// which a single float makes of a plain point.
static void the_search_finds_what_naive_forms_are_known_for_and_shrinks_it(void **state)
{
    (void)state;
    struct sb_findings findings;
    struct sb_error err = {0};
    search(SB_CASE_NAIVE, 2, &findings);
    assert_true(findings.count > 0);
    assert_true(isinf(findings.row[0].measured));
    assert_int_equal(count_changes(&findings.row[0].points), 1);
    assert_true(sb_points_validate(&findings.row[0].points, &err));
    const struct sb_search_params params = {.form = SB_CASE_NAIVE};
    struct sb_text text = {0};
    sb_found_text(&findings.row[0], &params, 7, &text);
    check_contains(sb_text_get(&text), ".points = found_7,");
    check_contains(sb_text_get(&text), "f;\n}\n");
    sb_text_free(&text);
    sb_findings_free(&findings);
}

static void the_search_finds_nothing_infinite_in_robust_forms(void **state)
{
    (void)state;
    struct sb_findings findings;
    search(SB_CASE_ROBUST, 2, &findings);
    for (int i = 0; i < findings.count; i++)
        assert_true(isfinite(findings.row[i].measured));
    sb_findings_free(&findings);
}

// The square of a distance leaves half precision at 65520: at 255.97, and 255.875 is the last
// number below.
static void a_distance_breaks_half_precision_at_256(void **state)
{
    (void)state;
    struct sb_error err = {0};
    const struct sb_case *it = case_of("dist-overflow16");
    struct sb_breaking naive, robust;
    if (!sb_case_break(&case_env, it, SB_CASE_NAIVE, case_half, false, &naive, &err) ||
        !sb_case_break(&case_env, it, SB_CASE_ROBUST, case_half, false, &robust, &err))
        fail_msg("%s", err.text);
    assert_true(naive.holds_to > 200 && naive.holds_to < 256);
    assert_true(robust.to_the_end);
    sb_text_free(&naive.outcome.note);
    sb_text_free(&robust.outcome.note);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_distance_breaks_half_precision_at_256),
        cmocka_unit_test(the_search_finds_what_naive_forms_are_known_for_and_shrinks_it),
        cmocka_unit_test(the_search_finds_nothing_infinite_in_robust_forms),
    };
    return CASE_TESTS(tests);
}
