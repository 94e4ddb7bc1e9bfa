// The family `specular`: robust forms hold, naive ones do not, and highlights at random points,
// of both models, are what the catalogue allows.
#include "cases/directions.h"
#include "cases_asked.h"

static enum sb_case_precision half; // as this context has it

static void robust_forms_hold(void **state)
{
    (void)state;
    for (int i = 0; i < sb_cases_specular.count; i++) {
        asked_robust(&sb_cases_specular.row[i], SB_CASE_HIGHP);
        asked_robust(&sb_cases_specular.row[i], half);
    }
}

static void naive_forms_do_not(void **state)
{
    (void)state;
    static const char *const highp[] = {"spec-pow-32", "pow-negative-base",
                                        "spec-backface", "acos-angle"};
    static const char *const in_half[] = {"spec-pow-16", "spec-underflow-16"};
    for (size_t i = 0; i < sizeof highp / sizeof *highp; i++)
        asked_naive(highp[i], SB_CASE_HIGHP);
    for (size_t i = 0; i < sizeof in_half / sizeof *in_half; i++)
        asked_naive(in_half[i], half);
}

static void set(float out[3], struct sb_vec3 v, double scale)
{
    const double from[3] = {v.x, v.y, v.z};
    for (int c = 0; c < 3; c++)
        out[c] = (float)(scale * from[c]);
}

// Random normals, with eye and light anywhere above the surface: few points lie in a narrow
// highlight, so the angle between the half vector and the normal is drawn for it.
static void anywhere(struct sb_points *points, const struct sb_case_setting *setting,
                     double exponent)
{
    struct sb_random random = sb_random_seed(77);
    const bool weighted = sb_case_precisions[setting->precision].half;
    for (int i = 0; i < 400; i++) {
        const double angle = fmin(3 * sb_random_unit(&random) / sqrt(exponent), 0.7);
        const struct sb_vec3 h = sb_any_direction(&random);
        const struct sb_vec3 normal = sb_turned(&random, h, angle);
        const struct sb_vec3 view =
            sb_turned(&random, h, (1.4 - angle) * sb_random_unit(&random));
        const struct sb_vec3 to_light =
            sb_vec3_sub(sb_vec3_scale(h, 2 * sb_vec3_dot(h, view)), view);
        struct sb_point *point = sb_points_add(points);
        set(point->normal, normal, 1);
        set(point->eye, view, 1 + sb_random_unit(&random));
        set(point->material.diffuse, view, 0);
        set(sb_points_light(points, points->count - 1, 0)->direction, to_light, -1);
        point->material.shininess = (float)exponent;
        if (weighted)
            set(point->material.specular, (struct sb_vec3){1, 1, 1},
                exponent <= 64    ? 1
                : exponent <= 256 ? 0.5
                                  : 0.3);
    }
}

static void highlights_hold_elsewhere(void **state)
{
    (void)state;
    static const double high[] = {1, 50, 3000, 5e5, 0};
    static const double low[] = {2, 8, 24, 50, 100, 200, 700, 0};
    asked_others("spec-pow-32", SB_CASE_HIGHP, NULL, anywhere, high);
    asked_others("spec-pow-32", SB_CASE_HIGHP, "model=phong", anywhere, high);
    asked_others("spec-pow-16", half, NULL, anywhere, low);
}

int main(void)
{
    open_case_driver();
    const struct sb_case_env env = case_env(NULL);
    half = case_half(&env);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(robust_forms_hold),
        cmocka_unit_test(naive_forms_do_not),
        cmocka_unit_test(highlights_hold_elsewhere),
    };
    const int code = cmocka_run_group_tests(tests, NULL, NULL);
    sb_driver_close(&case_driver);
    return code;
}
