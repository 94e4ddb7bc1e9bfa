// The family `cones`: robust forms hold, naive ones do not, and so do cones of random angles.
#include "cases/directions.h"
#include "cases_asked.h"

static enum sb_case_precision half; // as this context has it

static void robust_forms_hold(void **state)
{
    (void)state;
    for (int i = 0; i < sb_cases_cones.count; i++) {
        asked_robust(&sb_cases_cones.row[i], SB_CASE_HIGHP);
        asked_robust(&sb_cases_cones.row[i], half);
    }
}

static void naive_forms_do_not(void **state)
{
    (void)state;
    static const char *const id[] = {"cone-narrow", "cutoff-0", "cutoff-90-180",
                                     "inner>=outer", "spot-exp"};
    for (size_t i = 0; i < sizeof id / sizeof *id; i++)
        asked_naive(id[i], SB_CASE_HIGHP);
    asked_naive("cone-narrow", half);
    asked_naive("spot-exp", half);
}

static void of_angle(struct sb_points *points, const struct sb_case_setting *setting,
                     double degrees)
{
    (void)setting;
    struct sb_random random = sb_random_seed(78);
    const double outer = degrees * SB_PI / 180;
    for (int i = 0; i < 300; i++)
        sb_points_in_cone(points, &random,
                          fmin(1.2 * outer, SB_PI) * sb_random_unit(&random),
                          outer * sb_random_unit(&random), outer);
}

static void of_exponent(struct sb_points *points, const struct sb_case_setting *setting,
                        double exponent)
{
    (void)setting;
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

static void cones_hold_elsewhere(void **state)
{
    (void)state;
    static const double high[] = {0.03, 0.5, 17, 77, 150, 0};
    static const double low[] = {11, 33, 77, 130, 0};
    static const double great[] = {0.5, 30, 3e5, 0}, small[] = {0.5, 4, 15, 50, 0};
    asked_others("cone-narrow", SB_CASE_HIGHP, NULL, of_angle, high);
    asked_others("cone-narrow", half, NULL, of_angle, low);
    asked_others("spot-exp", SB_CASE_HIGHP, NULL, of_exponent, great);
    asked_others("spot-exp", half, NULL, of_exponent, small);
}

int main(void)
{
    open_case_driver();
    const struct sb_case_env env = case_env(NULL);
    half = case_half(&env);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(robust_forms_hold),
        cmocka_unit_test(naive_forms_do_not),
        cmocka_unit_test(cones_hold_elsewhere),
    };
    const int code = cmocka_run_group_tests(tests, NULL, NULL);
    sb_driver_close(&case_driver);
    return code;
}
