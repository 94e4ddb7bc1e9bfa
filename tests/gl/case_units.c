// Units: the program that lights points of a table agrees with the reference at random points, in
// both stages, for every type of light and formula; and what a row holds arrives.
#include "case_world.h"
#include "cases/unit.h"
#include "measure/explain.h"

static void open_unit(struct sb_unit *unit, const char *words, struct sb_variant *variant)
{
    struct sb_error err = {0};
    const struct sb_case it = {.given = words};
    *unit = (struct sb_unit){0};
    if (!sb_case_variant(&case_env, &it, SB_CASE_ROBUST, SB_CASE_HIGHP, false, NULL,
                         variant, &err) ||
        !sb_case_unit_open(unit, &case_env, variant, &err))
        fail_msg("%s: %s", words, err.text);
}

static float between(struct sb_random *random, double low, double high)
{
    return (float)(low + (high - low) * sb_random_unit(random));
}

// Points around a lit half space, so that most of them are lit.
static void scatter(struct sb_points *points, int count)
{
    struct sb_random random = sb_random_seed(7);
    for (int p = 0; p < count; p++) {
        struct sb_point *point = sb_points_add(points);
        for (int c = 0; c < 3; c++) {
            point->position[c] = between(&random, -0.5, 0.5);
            point->normal[c] = (float)(c == 2) + between(&random, -0.5, 0.5);
            point->eye[c] = 2 * (float)(c == 2) + between(&random, -1, 1);
            point->material.diffuse[c] = between(&random, 0, 0.5);
            point->material.specular[c] = between(&random, 0, 0.5);
            for (int m = 0; m < SB_MAP_COUNT; m++)
                point->texel[m][c] =
                    m == SB_MAP_NORMAL && c == 2 ? 0.9f : between(&random, 0.2, 0.8);
        }
        point->ambient[p % 3] = 0.1f;
        point->material.ambient[p % 3] = 0.5f;
        point->material.shininess = between(&random, 1, 64);
        for (int i = 0; i < points->lights; i++) {
            struct sb_light *light = sb_points_light(points, p, i);
            for (int c = 0; c < 2; c++)
                light->position[c] = between(&random, -0.5, 0.5);
            light->position[2] = between(&random, 1, 2);
            light->linear = between(&random, 0, 1);
            light->quadratic = between(&random, 0, 1);
            light->range = between(&random, 3, 5);
            sb_light_set_cone(light, 0.2, between(&random, 0.5, 1.5));
        }
    }
}

static void check_variant(const char *words)
{
    struct sb_variant variant;
    struct sb_unit unit;
    struct sb_points points;
    struct sb_unit_told told;
    struct sb_points_truth truth;
    struct sb_error err = {0};
    open_unit(&unit, words, &variant);
    sb_points_init(&points, &variant);
    scatter(&points, 600);
    assert_true(sb_points_validate(&points, &err));
    if (!sb_unit_light(&unit, &points, points.lights, &told, &err))
        fail_msg("%s: %s", words, err.text);
    sb_points_truth_make(&points, &variant, &truth);
    double worst = 0;
    const bool vertex = variant.value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    for (int p = 0; p < points.count; p++) {
        const float *colour = sb_told_colour(&told, p);
        const struct sb_vec3 right = vertex ? truth.shade[p].diffuse : truth.colour[p];
        if (truth.shade[p].margin < 1e-4)
            continue;
        worst =
            fmax(worst, fmax(fabs(colour[0] - right.x),
                             fmax(fabs(colour[1] - right.y), fabs(colour[2] - right.z))));
        for (int i = 0; i < points.lights; i++)
            check_close(sb_told_page(&told.light[i], p)[4],
                        truth.terms[p * points.lights + i].n_dot_l[0], 1e-5);
        check_close(sb_told_page(&told.inputs, p)[0], points.point[p].position[0], 0);
    }
    printf("%-60s %.3g\n", words, worst);
    if (worst > 2e-5)
        fail_msg("%s: %g", words, worst);
    sb_points_truth_free(&truth);
    sb_unit_told_free(&told);
    sb_points_free(&points);
    sb_unit_close(&unit);
}

static void test_variants(void **state)
{
    (void)state;
    static const char *const variants[] = {
        "dir=1 point=2 spot=2 area=1",
        "dir=1 point=2 spot=2 area=1 stage=vertex",
        "dir=1 point=2 spot=2 layout=unified cone=linear model=phong",
        "spot=1 cone=exponent attenuation=radius",
        "spot=1 cone=hard attenuation=windowed stage=vertex ambient=none",
        "area=1 area_shape=tube model=lambert",
        "area=1 area_shape=capsule",
        "area=1 area_shape=box stage=vertex",
        "point=1 maps=diffuse+specular+normal",
        "point=1 normalise=on ambient=per_light attenuation=none",
        "point=9",
    };
    for (size_t i = 0; i < sizeof variants / sizeof *variants; i++)
        check_variant(variants[i]);
}

// Ten contributions of 0.1 of a step vanish in 8 bits, one by one; in half floats they do not.
static void test_adding(void **state)
{
    (void)state;
    static const char *const variants[] = {
        "point=1 ambient=none model=lambert",
        "point=1 ambient=none model=lambert target=rgba16f"};
    for (int v = 0; v < 2; v++) {
        struct sb_variant variant;
        struct sb_unit unit;
        struct sb_points points;
        struct sb_image sums = {0};
        struct sb_error err = {0};
        open_unit(&unit, variants[v], &variant);
        sb_points_init(&points, &variant);
        for (int p = 0; p < 20; p++)
            for (int c = 0; c < 3; c++)
                sb_points_add(&points)->material.diffuse[c] = 0;
        for (int p = 0; p < 60; p++)
            for (int c = 0; c < 3; c++)
                points.point[p].material.diffuse[c] = p < 10 ? 0.1f / 255 : 0.5f;
        if (!sb_unit_add(&unit, &points, 10, &sums, &err))
            fail_msg("%s", err.text);
        assert_int_equal(sums.width, 6);
        check_close(sums.data[0], v == 0 ? 0 : 1.0 / 255, 1e-4);
        check_close(sums.data[4], v == 0 ? 1 : 5, 1e-2);
        sb_image_free(&sums);
        sb_points_free(&points);
        sb_unit_close(&unit);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_variants),
        cmocka_unit_test(test_adding),
    };
    return CASE_TESTS(tests);
}
