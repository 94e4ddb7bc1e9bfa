// Distance, attenuation and range: robust forms hold, naive ones fail where the catalogue says, and
// robust ones hold at inputs that are not in the catalogue.
#include "case_world.h"

static void test_forms(void **state)
{
    (void)state;
    check_robust(&sb_cases_distance);
    check_vertex("light-on-surface");
    check_naive("light-on-surface", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("att-kc0", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("att-all-zero", SB_IN_HIGHP);
    check_naive("dist-overflow16", SB_IN_HALF);
    check_naive("dist-underflow16", SB_IN_HALF);
    check_naive("dist-range32", SB_IN_HIGHP);
    check_naive("radius-falloff", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("hdr-overflow", SB_IN_HIGHP | SB_IN_HALF);
    check_naive("neg-denorm-intensity", SB_IN_HIGHP);
    check_naive("lowp-range", SB_IN_FIXED);
}

// Lights in random directions, logarithmically from `nearest` to `farthest`.
struct shell {
    double nearest, farthest;
    double quadratic; // 1: an inverse square law; 0: 1 / d
};

static void scatter(struct sb_points *points, const struct sb_case_setting *setting,
                    const void *user)
{
    (void)setting;
    const struct shell *shell = user;
    struct sb_random random = sb_random_seed(31);
    for (int p = 0; p < 400; p++) {
        sb_points_add(points);
        struct sb_light *light = sb_points_light(points, p, 0);
        const double d = shell->nearest *
                         pow(shell->farthest / shell->nearest, sb_random_unit(&random));
        double v[3], length = 0;
        for (int c = 0; c < 3; c++) {
            v[c] = 2 * sb_random_unit(&random) - 1;
            length += v[c] * v[c];
        }
        for (int c = 0; c < 3; c++)
            light->position[c] = (float)(d * v[c] / sqrt(length));
        light->constant = 0;
        light->linear = (float)(1 - shell->quadratic);
        light->quadratic = (float)shell->quadratic;
        light->range = (float)(d * (0.5 + sb_random_unit(&random)));
    }
}

static void check_shell(const struct sb_case *it, const struct shell *shell)
{
    check_inputs(it, ~0u, &(struct inputs){.add = scatter, .user = shell});
}

static void test_other_inputs(void **state)
{
    (void)state;
    check_shell(case_of("dist-overflow16"), &(struct shell){1e-3, 3e4, 0});
    check_shell(case_of("dist-underflow16"), &(struct shell){1e-3, 1, 0});
    check_shell(case_of("radius-falloff"), &(struct shell){0.05, 200, 0});
    struct sb_case unordered = *case_of("att-kc0"); // the points are in no order
    unordered.criterion[1].figure = SB_FIGURE_NONE;
    check_shell(&unordered, &(struct shell){1e-9, 200, 1});
}

// Near half floats' least, where a device may flush what is below 2^-14: all of it is 0 there. The
// flag is the emulation's.
static void test_flushed(void **state)
{
    (void)state;
    // In highp, or emulated, both APIs run the same shaders: the one without half floats asks.
    if (case_half == SB_CASE_HALF)
        return;
    const struct inputs inputs = {.add = scatter,
                                  .user = &(struct shell){1e-3, 1, 0},
                                  .more = "emulate_subnormals=flush"};
    each_precision(case_of("dist-underflow16"), SB_CASE_ROBUST, 1u << SB_CASE_EMULATED,
                   look_at_inputs, &inputs);
}

// What the validator refuses it calls by light and field.
static void test_refused(void **state)
{
    (void)state;
    check_refused("att-all-zero", "constant, linear and quadratic are all 0");
    check_refused("dist-range32", "point light 0: position[0]");
    check_refused("neg-denorm-intensity", "point light 0: diffuse[0] is -1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_other_inputs),
        cmocka_unit_test(test_flushed),
        cmocka_unit_test(test_refused),
    };
    return CASE_TESTS(tests);
}
