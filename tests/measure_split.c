// The split of an error: its parts add up, and what must be left out is.
#include "test.h"

#include "base/mem.h"
#include "measure/explain.h"
#include "measure/split.h"

enum { SIDE = 16 };

// A sphere, its reference, and a driver that draws exactly that unless a test says otherwise.
struct world {
    struct sb_variant variant;
    struct sb_scene scene;
    struct sb_ref_ground ground;
    struct sb_ref_picture ideal, model, given;
    struct sb_image geometry, wide, own, probe;
    struct sb_split_params params;
};

static void copy_picture(const struct sb_ref_picture *from, struct sb_image *to)
{
    sb_image_init(to, SIDE, SIDE, 4);
    for (long i = 0; i < SIDE * SIDE; i++)
        for (int c = 0; c < 3; c++)
            to->data[4 * i + c] = (float)from->colour.data[3 * i + c];
}

static void world_make(struct world *w)
{
    struct sb_error err = {0};
    *w = (struct world){0};
    sb_variant_init(sb_axes_builtin(), &w->variant);
    sb_variant_put(&w->variant, SB_AXIS_DIR, 1);
    sb_variant_put(&w->variant, SB_AXIS_WIDTH, SIDE);
    sb_variant_put(&w->variant, SB_AXIS_HEIGHT, SIDE);
    assert_true(sb_variant_resolve(sb_axes_builtin(), &w->variant, &err));
    assert_true(sb_scene_make("containers", &w->variant, &w->scene, &err));
    sb_ref_ground_make(&w->ground, &w->scene, SIDE, SIDE, 2);
    sb_ref_ideal(&w->ground, &w->variant, &w->ideal);
    sb_ref_model(&w->ground, &w->variant, &w->model);
    sb_ref_model(&w->ground, &w->variant, &w->given);
    sb_image_init(&w->geometry, SIDE, SIDE, 4);
    sb_image_init(&w->probe, SIDE, SIDE, 16);
    for (long i = 0; i < SIDE * SIDE; i++) {
        w->geometry.data[4 * i] = (float)(w->ground.cover[i].draw + 1);
        w->geometry.data[4 * i + 1] = (float)(w->ground.cover[i].triangle + 1);
        w->probe.data[16 * i + 14] = (float)w->given.decisions[i];
    }
    copy_picture(&w->ideal, &w->wide);
    copy_picture(&w->ideal, &w->own);
    w->params = (struct sb_split_params){
        .ground = &w->ground,
        .ideal = &w->ideal,
        .model = &w->model,
        .given = &w->given,
        .geometry = &w->geometry,
        .wide = &w->wide,
        .own = &w->own,
        .probe = &w->probe,
        .decision_bound = 2, // of cosines: any flip is left out
    };
}

static void world_free(struct world *w)
{
    sb_ref_picture_free(&w->ideal);
    sb_ref_picture_free(&w->model);
    sb_ref_picture_free(&w->given);
    sb_image_free(&w->geometry);
    sb_image_free(&w->wide);
    sb_image_free(&w->own);
    sb_image_free(&w->probe);
    sb_ref_ground_free(&w->ground);
    sb_scene_free(&w->scene);
}

// A pixel that is covered.
static long covered(const struct world *w)
{
    long i = 0;
    while (w->ground.cover[i].draw < 0)
        i++;
    return i;
}

static struct sb_split measured(const struct world *w)
{
    struct sb_split split;
    sb_split_measure(&w->params, &split);
    free(split.counted);
    split.counted = NULL;
    return split;
}

static void a_driver_that_draws_the_ideal_has_no_error(void **state)
{
    (void)state;
    struct world w;
    world_make(&w);
    const struct sb_split split = measured(&w);
    long pixels = 0;
    for (long i = 0; i < SIDE * SIDE; i++)
        pixels += w.ground.cover[i].draw >= 0;
    assert_int_equal(split.compared, pixels);
    assert_int_equal(split.mismatched + split.flips, 0);
    for (int p = 0; p < SB_BY_COUNT; p++)
        assert_true(split.part[p].max < 1e-7);
    assert_true(isnan(split.gouraud));
    world_free(&w);
}

static void each_step_lands_in_its_part_and_the_parts_add_up(void **state)
{
    (void)state;
    struct world w;
    world_make(&w);
    const long i = covered(&w);
    w.model.colour.data[3 * i] += 0.1;
    w.given.colour.data[3 * i] += 0.1 - 0.25;
    w.wide.data[4 * i] += 0.1f - 0.25f + 0.5f;
    w.own.data[4 * i] += 0.1f - 0.25f + 0.5f - 0.0625f;
    const struct sb_split split = measured(&w);
    check_close(split.part[SB_BY_FORMULATION].max, 0.1, 1e-6);
    check_close(split.part[SB_BY_INTERPOLATION].max, 0.25, 1e-6);
    check_close(split.part[SB_BY_ARITHMETIC].max, 0.5, 1e-6);
    check_close(split.part[SB_BY_QUANTISATION].max, 0.0625, 1e-6);
    assert_int_equal(split.part[SB_BY_ARITHMETIC].x, i % SIDE);
    assert_int_equal(split.part[SB_BY_ARITHMETIC].y, i / SIDE);
    check_close(split.part[SB_BY_ARITHMETIC].mean, 0.5 / (3 * (double)split.compared),
                1e-6);
    world_free(&w);
}

static void a_pixel_of_another_triangle_is_left_out_and_counted(void **state)
{
    (void)state;
    struct world w;
    world_make(&w);
    const long i = covered(&w);
    const struct sb_split before = measured(&w);
    w.geometry.data[4 * i + 1] += 1;
    w.own.data[4 * i] = w.wide.data[4 * i] = 9;
    const struct sb_split split = measured(&w);
    assert_int_equal(split.mismatched, 1);
    assert_int_equal(split.compared, before.compared - 1);
    assert_true(split.part[SB_BY_ARITHMETIC].max < 1e-7);
    world_free(&w);
}

static void a_flipped_branch_is_left_out_and_counted(void **state)
{
    (void)state;
    struct world w;
    world_make(&w);
    const long i = covered(&w);
    w.probe.data[16 * i + 14] += 1;
    w.own.data[4 * i] = w.wide.data[4 * i] = 9;
    struct sb_split split = measured(&w);
    assert_int_equal(split.flips, 1);
    assert_true(split.part[SB_BY_ARITHMETIC].max < 1e-7);
    // Without a probe the branches of the driver are not known, and nor are its inputs.
    w.params.probe = NULL;
    w.params.given = NULL;
    split = measured(&w);
    assert_int_equal(split.flips, -1);
    assert_int_equal(split.raw_nonfinite, -1);
    assert_true(isnan(split.part[SB_BY_ARITHMETIC].max));
    assert_true(isnan(split.part[SB_BY_INTERPOLATION].mean));
    assert_false(isnan(split.part[SB_BY_FORMULATION].max));
    world_free(&w);
}

static void a_branch_that_rounding_does_not_explain_is_an_error(void **state)
{
    (void)state;
    struct world w;
    world_make(&w);
    const long i = covered(&w);
    const float margin = w.given.margin[i];
    assert_true(margin > 0 && margin < 1); // |n . l|
    w.probe.data[16 * i + 14] += 1;
    w.own.data[4 * i] = w.wide.data[4 * i] = 9;
    w.params.decision_bound = 1.01 * margin;
    assert_true(measured(&w).part[SB_BY_ARITHMETIC].max < 1e-7);
    w.params.decision_bound = 0.99 * margin;
    const struct sb_split split = measured(&w);
    assert_int_equal(split.flips, 1);
    assert_true(split.part[SB_BY_ARITHMETIC].max > 1);
    world_free(&w);
}

static void raw_terms_are_summed_over_pixels(void **state)
{
    (void)state;
    struct world w;
    world_make(&w);
    w.probe.data[12] = 2;
    w.probe.data[16 * 5 + 12] = 3;
    w.probe.data[16 * 5 + 13] = 1;
    const struct sb_split split = measured(&w);
    assert_int_equal(split.raw_nonfinite, 5);
    assert_int_equal(split.raw_negative, 1);
    world_free(&w);
}

static void ulps_are_those_of_the_format(void **state)
{
    (void)state;
    check_close(sb_ulps(nextafterf(1, 2), 1, 0, 24), 1, 1e-9);
    check_close(sb_ulps(nextafterf(1000, 2000), 1000, 0, 24), 1, 1e-9);
    check_close(sb_ulps(1 + 0x1p-10, 1, 0, 11), 1, 1e-9);
    check_close(sb_ulps(0x1p-10, 0, 1, 11), 1, 1e-9); // of the floor
    // Below the smallest normal number the step stays.
    check_close(sb_ulps(0x1p-24, 0, 0, 11), 1, 1e-9);
    check_close(sb_ulps(0x1p-149, 0, 0, 24), 1, 1e-9);
    assert_true(isinf(sb_ulps(NAN, 1, 1, 24)));
    assert_true(isinf(sb_ulps(INFINITY, 1, 1, 24)));
    check_close(sb_ulps(INFINITY, INFINITY, 1, 24), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_driver_that_draws_the_ideal_has_no_error),
        cmocka_unit_test(each_step_lands_in_its_part_and_the_parts_add_up),
        cmocka_unit_test(a_pixel_of_another_triangle_is_left_out_and_counted),
        cmocka_unit_test(a_flipped_branch_is_left_out_and_counted),
        cmocka_unit_test(a_branch_that_rounding_does_not_explain_is_an_error),
        cmocka_unit_test(raw_terms_are_summed_over_pixels),
        cmocka_unit_test(ulps_are_those_of_the_format),
    };
    return run_tests(tests);
}
