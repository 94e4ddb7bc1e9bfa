// The cases of area lights, and lights in other places than theirs.
#include "case_world.h"

static void test_robust_forms_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_area);
    check_vertex("box-inside");
}

static void test_naive_forms_fail(void **state)
{
    (void)state;
    check_naive("sphere-centre", SB_IN_HIGHP);
    check_naive("tube-parallel", SB_IN_HIGHP);
    check_naive("capsule-degenerate", SB_IN_HIGHP);
    check_naive("box-inside", SB_IN_HIGHP);
    check_naive("area-to-point", SB_IN_HALF); // where the square of 1e-6 is 0
}

static void test_triggers_are_valid(void **state)
{
    (void)state;
    check_family_valid(&sb_cases_area);
}

static float between(struct sb_random *random, double low, double high)
{
    return (float)(low + (high - low) * sb_random_unit(random));
}

// Lights of all sizes above and below a surface, many of which reach through it, seen from anywhere.
static void scatter(struct sb_points *points, const struct sb_case_setting *setting,
                    const void *user)
{
    (void)setting;
    (void)user;
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
    for (int i = 0; i < sb_cases_area.count; i++) {
        struct sb_case it = sb_cases_area.row[i];
        if (!it.points)
            continue;
        it.criterion[0] = (struct sb_criterion){SB_FIGURE_FINITE, 0, 0, 0};
        it.criterion[1] = (struct sb_criterion){SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, NAN};
        check_inputs(&it, ~0u, &(struct inputs){.add = scatter, .any = true});
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_robust_forms_hold),
        cmocka_unit_test(test_naive_forms_fail),
        cmocka_unit_test(test_triggers_are_valid),
        cmocka_unit_test(test_other_lights),
    };
    return CASE_TESTS(tests);
}
