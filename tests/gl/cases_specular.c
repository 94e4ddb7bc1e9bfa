// The family `specular`: robust forms hold, naive ones do not, and highlights at random points,
// of both models, are what the catalogue allows.
#include "cases/directions.h"
#include "case_world.h"

static void robust_forms_hold(void **state)
{
    (void)state;
    check_robust(&sb_cases_specular);
    check_vertex("spec-pow-32");
}

static void naive_forms_do_not(void **state)
{
    (void)state;
    check_naive("spec-pow-16", SB_IN_HALF);
    check_naive("spec-pow-32", SB_IN_HIGHP);
    check_naive("pow-negative-base", SB_IN_HIGHP);
    check_naive("spec-underflow-16", SB_IN_HALF);
    check_naive("spec-backface", SB_IN_HIGHP);
    check_naive("acos-angle", SB_IN_HIGHP);
}

static void set(float out[3], struct sb_vec3 v, double scale)
{
    const double from[3] = {v.x, v.y, v.z};
    for (int c = 0; c < 3; c++)
        out[c] = (float)(scale * from[c]);
}

// Random normals, with eye and light anywhere above the surface: few points lie in a narrow
// highlight, so the angle between the half vector and the normal is drawn for it.
static void anywhere(struct sb_points *points, double exponent, bool weighted)
{
    struct sb_random random = sb_random_seed(77);
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

// With each exponent of a list that ends with 0.
static void of_exponents(struct sb_points *points, const struct sb_case_setting *setting,
                         const void *user)
{
    for (const double *at = user; *at > 0; at++)
        anywhere(points, *at, sb_case_precisions[setting->precision].half);
}

static void highlights_hold_elsewhere(void **state)
{
    (void)state;
    static const double high[] = {1, 50, 3000, 5e5, 0};
    static const double low[] = {2, 8, 24, 50, 100, 200, 700, 0};
    const struct sb_case *full = case_of("spec-pow-32"), *half = case_of("spec-pow-16");
    check_inputs(full, SB_IN_HIGHP, &(struct inputs){.add = of_exponents, .user = high});
    check_inputs(
        full, SB_IN_HIGHP,
        &(struct inputs){.add = of_exponents, .user = high, .more = "model=phong"});
    check_inputs(half, SB_IN_HALF, &(struct inputs){.add = of_exponents, .user = low});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(robust_forms_hold),
        cmocka_unit_test(naive_forms_do_not),
        cmocka_unit_test(highlights_hold_elsewhere),
    };
    return CASE_TESTS(tests);
}
