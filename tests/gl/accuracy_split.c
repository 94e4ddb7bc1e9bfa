// Where an error comes from: one that is put into a single place must show up in its part of the
// split, and in no other.
#include "accuracy_world.h"

#include <unistd.h>

static char folder[64];

// A copy of the shaders with one edit, a sed expression, in one file.
static const char *edited(const char *file, const char *edit)
{
    char command[1024];
    snprintf(command, sizeof command,
             "rm -rf '%s/shaders'; cp -r '" SB_SOURCE_DIR "/shaders' '%s/' && "
             "sed -i '%s' '%s/shaders/%s' && ! cmp -s '" SB_SOURCE_DIR
             "/shaders/%s' '%s/shaders/%s'",
             folder, folder, edit, folder, file, file, folder, file);
    assert_int_equal(system(command), 0);
    static char path[80];
    snprintf(path, sizeof path, "%s/shaders", folder);
    return path;
}

#define PLAIN "dir=1,point=2,spot=1,target=rgba32f,width=128,height=128"

static void a_skipped_renormalisation_is_an_error_of_the_formulation(void **state)
{
    (void)state;
    struct one one;
    one_measure(&one, &(struct one_params){
                          .scene = "sphere",
                          .words = PLAIN ",tessellation=300,normalise=off",
                      });
    assert_true(share_of(&one, SB_BY_FORMULATION) >= 0.95);
    one_free(&one);
}

static void quantised_varyings_are_an_error_of_the_interpolation(void **state)
{
    (void)state;
    struct one one;
    one_measure(&one, &(struct one_params){
                          .scene = "containers",
                          .words = PLAIN,
                          .shaders = edited("stage/fragment.vert",
                                            "s/v_position = position;/v_position = "
                                            "floor(position * 64.0 + 0.5) \\/ 64.0;/"),
                      });
    assert_true(share_of(&one, SB_BY_INTERPOLATION) >= 0.95);
    one_free(&one);
}

static void a_factor_on_the_cone_is_an_error_of_the_arithmetic_and_named(void **state)
{
    (void)state;
    static const struct {
        const char *cone, *edit;
    } cones[] = {
        {"smooth", "s/ramp.y, 0.0, 1.0)/ramp.y, 0.0, 1.0) * 1.001/"},
        {"linear", "s/return max(1.0 - one_minus_cos \\* inverse, 0.0)/"
                   "return 1.001 * max(1.0 - one_minus_cos * inverse, 0.0)/"},
    };
    for (size_t i = 0; i < sizeof cones / sizeof *cones; i++) {
        char words[160], file[64];
        struct one one;
        snprintf(words, sizeof words, PLAIN ",cone=%s", cones[i].cone);
        snprintf(file, sizeof file, "cone/%s.glsl", cones[i].cone);
        one_measure(&one, &(struct one_params){
                              .scene = "containers",
                              .words = words,
                              .shaders = edited(file, cones[i].edit),
                          });
        assert_true(share_of(&one, SB_BY_ARITHMETIC) >= 0.95);
        assert_non_null(one.task.accuracy.term);
        assert_string_equal(one.task.accuracy.term, "cone");
        one_free(&one);
    }
}

static void the_rounding_of_the_target_is_an_error_of_the_quantisation(void **state)
{
    (void)state;
    struct one one;
    one_measure(&one, &(struct one_params){
                          .scene = "containers",
                          .words = "dir=1,width=128,height=128", // nothing is above 1
                      });
    assert_true(share_of(&one, SB_BY_QUANTISATION) >= 0.95);
    // At most half a step, and on average a quarter.
    check_close(one.task.accuracy.split.part[SB_BY_QUANTISATION].max, 0.5 / 255, 1e-4);
    check_close(one.task.accuracy.split.part[SB_BY_QUANTISATION].mean, 0.25 / 255, 5e-4);
    one_free(&one);
}

static void without_an_injected_error_all_parts_are_small(void **state)
{
    (void)state;
    struct one one;
    one_measure(&one, &(struct one_params){.scene = "containers", .words = PLAIN});
    for (int p = 0; p < SB_BY_COUNT; p++)
        assert_true(one.task.accuracy.split.part[p].max < 2e-4);
    assert_true(one.task.accuracy.split.part[SB_BY_FORMULATION].max == 0);
    assert_true(one.task.accuracy.split.part[SB_BY_QUANTISATION].max == 0);
    assert_true(one.task.accuracy.split.part[SB_BY_ARITHMETIC].max < 2e-5);
    assert_null(one.task.accuracy.term);
    one_free(&one);
}

static void gouraud_shading_has_two_errors(void **state)
{
    (void)state;
    struct one one;
    one_measure(&one, &(struct one_params){
                          .scene = "sphere",
                          .words = PLAIN ",stage=vertex,tessellation=300",
                      });
    const struct sb_accuracy *accuracy = &one.task.accuracy;
    // Coarse triangles lose highlights; but as Gouraud shading the picture is right.
    assert_true(accuracy->total.max > 0.02);
    assert_true(accuracy->split.gouraud < 1e-4);
    assert_true(share_of(&one, SB_BY_FORMULATION) >= 0.95);
    one_free(&one);
}

int main(void)
{
    open_driver();
    snprintf(folder, sizeof folder, "/tmp/shadebench-split-XXXXXX");
    assert_non_null(mkdtemp(folder));
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_skipped_renormalisation_is_an_error_of_the_formulation),
        cmocka_unit_test(quantised_varyings_are_an_error_of_the_interpolation),
        cmocka_unit_test(a_factor_on_the_cone_is_an_error_of_the_arithmetic_and_named),
        cmocka_unit_test(the_rounding_of_the_target_is_an_error_of_the_quantisation),
        cmocka_unit_test(without_an_injected_error_all_parts_are_small),
        cmocka_unit_test(gouraud_shading_has_two_errors),
    };
    const int failed = run_tests(tests);
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    sb_driver_close(&driver);
    return failed | (system(command) != 0);
}
