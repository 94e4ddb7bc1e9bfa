// Sums, masks, interpolation and compilers: robust forms hold, naive ones fail where the catalogue
// says, and robust ones hold at inputs that are not in the catalogue.
#include "case_world.h"

static void test_forms(void **state)
{
    (void)state;
    check_robust(&sb_cases_accumulation);
    check_vertex("nan-swallow");
    check_naive("sum-stagnation", SB_IN_HALF);
    check_naive("multipass-8bit", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("mask-multiply", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("nan-swallow", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("gouraud-highlight", SB_IN_HIGHP);
    check_naive("gouraud-nan", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("msaa-extrapolation", SB_IN_HIGHP);
    if (gl_test_gles()) // desktop GL knows no precision
        check_naive("link-precision", SB_IN_HIGHP);
}

// Sums of random lights, some of them very bright, and most overhead.
static void sum(struct sb_points *points, const struct sb_case_setting *setting,
                const void *user)
{
    (void)setting;
    (void)user;
    struct sb_random random = sb_random_seed(41);
    for (int p = 0; p < 8; p++) {
        sb_points_add(points);
        for (int i = 0; i < points->lights; i++)
            for (int c = 0; c < 3; c++)
                sb_points_light(points, p, i)->diffuse[c] =
                    (float)exp2(-16 * sb_random_unit(&random));
    }
}

// Normals of any length from 0 and 1e-12 on.
static void normals(struct sb_points *points, const struct sb_case_setting *setting,
                    const void *user)
{
    (void)setting;
    (void)user;
    struct sb_random random = sb_random_seed(42);
    for (int p = 0; p < 300; p++) {
        struct sb_point *point = sb_points_add(points);
        const double length = p % 10 ? pow(10, -12 * sb_random_unit(&random)) : 0;
        for (int c = 0; c < 3; c++)
            point->normal[c] = (float)(length * (2 * sb_random_unit(&random) - 1));
        if (p % 7 == 0)
            memcpy(sb_points_light(points, p, 0)->position, point->position,
                   sizeof point->position);
    }
}

static void test_other_inputs(void **state)
{
    (void)state;
    check_inputs(case_of("sum-stagnation"), ~0u, &(struct inputs){.add = sum});
    check_inputs(case_of("gouraud-nan"), ~0u, &(struct inputs){.add = normals});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_other_inputs),
    };
    return CASE_TESTS(tests);
}
