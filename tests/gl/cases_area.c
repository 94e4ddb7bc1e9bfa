// The cases of area lights, and lights in other places than theirs.
#include "case_family.h"
#include "math/random.h"

static void test_robust_forms_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_area);
}

static void test_naive_forms_fail(void **state)
{
    (void)state;
    for (int i = 0; i < sb_cases_area.count; i++) {
        const struct sb_case *it = &sb_cases_area.row[i];
        // Lights of no size: only in half precision, where 1e-6 squared is 0.
        const bool half = strcmp(it->id, "area-to-point") == 0;
        if (!half)
            check_cell(it, SB_CASE_NAIVE, SB_CASE_HIGHP, false, SB_VERDICT_FAIL);
        else
            check_cell(it, SB_CASE_NAIVE, SB_CASE_EMULATED, false, SB_VERDICT_FAIL);
    }
}

// What is asked could be a scene's.
static void test_triggers_are_valid(void **state)
{
    (void)state;
    const struct sb_case_env env = case_env();
    for (int i = 0; i < sb_cases_area.count; i++) {
        const struct sb_case *it = &sb_cases_area.row[i];
        struct sb_variant variant;
        struct sb_points points;
        struct sb_error err = {0};
        if (!it->points)
            continue;
        if (!sb_case_variant(&env, it, SB_CASE_ROBUST, SB_CASE_HIGHP, false, NULL,
                             &variant, &err))
            fail_msg("%s", err.text);
        const struct sb_case_setting setting = {.variant = &variant};
        sb_points_init(&points, &variant);
        it->points(&points, &setting);
        assert_true(points.count > 0);
        if (!sb_points_validate(&points, &err))
            fail_msg("%s: %s", it->id, err.text);
        sb_points_free(&points);
    }
}

static float between(struct sb_random *random, double low, double high)
{
    return (float)(low + (high - low) * sb_random_unit(random));
}

// Lights of all sizes above and below a surface, many of which reach through it, seen from anywhere.
static void scatter(struct sb_points *points)
{
    struct sb_random random = sb_random_seed(11);
    for (int p = 0; p < 2000; p++) {
        struct sb_point *point = sb_points_add(points);
        struct sb_light *light = sb_points_light(points, p, 0);
        for (int c = 0; c < 3; c++) {
            point->eye[c] = between(&random, -1, 1) + (float)(c == 2);
            light->position[c] = between(&random, -1, 1);
            light->direction[c] = between(&random, -1, 1);
            light->extent[c] = between(&random, 0, 1);
            if (p % 4 == 0) // along the eye's own ray
                point->eye[c] = light->position[c] = (float)(c == 2);
            if (p % 8 == 0)
                light->direction[c] = (float)(c == 2);
        }
        light->radius = between(&random, 0, 0.5);
    }
}

// Nothing that is not finite comes of them in any precision, and in highp all of it is right.
static void test_other_lights(void **state)
{
    (void)state;
    const struct sb_case_env env = case_env();
    for (int i = 0; i < sb_cases_area.count; i++)
        for (int precision = 0; precision < SB_CASE_PRECISION_COUNT; precision++) {
            struct sb_case it = sb_cases_area.row[i];
            struct sb_variant variant;
            struct sb_points points;
            struct sb_outcome outcome = {0};
            struct sb_error err = {0};
            const struct sb_case_setting setting = {
                SB_CASE_ROBUST, (enum sb_case_precision)precision, false, &variant};
            if (!it.points || !is_asked(&it, precision, 0) ||
                sb_case_unavailable(&env, setting.precision, false))
                continue;
            it.criterion[0] = (struct sb_criterion){SB_FIGURE_FINITE, 0, 0, 0};
            it.criterion[1] =
                (struct sb_criterion){SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, NAN};
            if (!sb_case_variant(&env, &it, SB_CASE_ROBUST, setting.precision, false,
                                 NULL, &variant, &err))
                fail_msg("%s", err.text);
            sb_points_init(&points, &variant);
            scatter(&points);
            if (!sb_case_ask_points(&env, &it, &setting, &points, &outcome, &err))
                fail_msg("%s", err.text);
            printf("%-20s %-8s %.4g of %.4g\n", it.id, sb_case_precisions[precision].name,
                   outcome.measured, outcome.bound);
            assert_int_equal(outcome.verdict, SB_VERDICT_PASS);
            sb_points_free(&points);
        }
}

int main(void)
{
    open_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_robust_forms_hold),
        cmocka_unit_test(test_naive_forms_fail),
        cmocka_unit_test(test_triggers_are_valid),
        cmocka_unit_test(test_other_lights),
    };
    return run_family(tests, sizeof tests / sizeof *tests);
}
