// The family `cones`: robust forms hold, naive ones do not, and so do cones of random angles.
#include "cases/directions.h"
#include "case_world.h"

static void robust_forms_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_cones);
    check_vertex("cone-narrow");
}

static void naive_forms_do_not(void **state)
{
    (void)state;
    check_naive("cone-narrow", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("cutoff-0", SB_IN_HIGHP);
    check_naive("cutoff-90-180", SB_IN_HIGHP);
    check_naive("inner>=outer", SB_IN_HIGHP);
    check_naive("spot-exp", SB_IN_HIGHP | SB_IN_HALF);
}

static void of_angle(struct sb_points *points, double degrees)
{
    struct sb_random random = sb_random_seed(78);
    const double outer = degrees * SB_PI / 180;
    for (int i = 0; i < 300; i++)
        sb_points_in_cone(points, &random,
                          fmin(1.2 * outer, SB_PI) * sb_random_unit(&random),
                          outer * sb_random_unit(&random), outer);
}

static void of_exponent(struct sb_points *points, double exponent)
{
    struct sb_random random = sb_random_seed(79);
    for (int i = 0; i < 300; i++) {
        const double reach = fmin(3 / sqrt(exponent), 2);
        struct sb_light *light =
            sb_points_in_cone(points, &random, reach * sb_random_unit(&random), 1, 3);
        light->exponent = (float)exponent;
        for (int c = 0; c < 3; c++) {
            light->ambient[c] = 1;
            light->diffuse[c] = 0;
            points->point[points->count - 1].material.ambient[c] = 1;
        }
    }
}

// At each number of a list that ends with 0.
static void of_angles(struct sb_points *points, const struct sb_case_setting *setting,
                      const void *user)
{
    (void)setting;
    for (const double *at = user; *at > 0; at++)
        of_angle(points, *at);
}

static void of_exponents(struct sb_points *points, const struct sb_case_setting *setting,
                         const void *user)
{
    (void)setting;
    for (const double *at = user; *at > 0; at++)
        of_exponent(points, *at);
}

static void cones_hold_elsewhere(void **state)
{
    (void)state;
    static const double high[] = {0.03, 0.5, 17, 77, 150, 0};
    static const double low[] = {11, 33, 77, 130, 0};
    static const double great[] = {0.5, 30, 3e5, 0}, small[] = {0.5, 4, 15, 50, 0};
    const struct sb_case *narrow = case_of("cone-narrow"), *power = case_of("spot-exp");
    check_inputs(narrow, SB_IN_HIGHP, &(struct inputs){.add = of_angles, .user = high});
    check_inputs(narrow, SB_IN_HALF, &(struct inputs){.add = of_angles, .user = low});
    check_inputs(power, SB_IN_HIGHP,
                 &(struct inputs){.add = of_exponents, .user = great});
    check_inputs(power, SB_IN_HALF, &(struct inputs){.add = of_exponents, .user = small});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(robust_forms_hold),
        cmocka_unit_test(naive_forms_do_not),
        cmocka_unit_test(cones_hold_elsewhere),
    };
    return CASE_TESTS(tests);
}
