// Pictures of jobs.
#include "local_jobs.h"

static void a_flat_colour_is_exact_and_covers_what_the_ids_cover(void **state)
{
    (void)state;
    static const float want[4] = {2, 0.25f, -1, 0.5f};
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_image colour, id;
    struct sb_scene scene = {0};
    struct sb_error err = {0};
    job_init(&it, 1, flat);
    prepare(&it, &prepared);
    image_of(1, SB_IMAGE_COLOUR, &colour);
    image_of(1, SB_IMAGE_ID, &id);
    assert_true(sb_scene_make("sphere", &it.job.variant, &scene, &err));
    assert_int_equal(colour.width, SIZE);
    assert_int_equal(colour.height, SIZE);
    assert_int_equal(colour.channels, 4);
    assert_int_equal(id.channels, 1);
    int64_t covered = 0;
    for (long i = 0; i < SIZE * SIZE; i++) {
        const bool inside = id.data[i] != 0;
        covered += inside;
        assert_memory_equal(&colour.data[4 * i], inside ? want : scene.clear_colour,
                            sizeof want);
    }
    assert_in_range(covered, SIZE * SIZE / 10, SIZE * SIZE - 1);
    assert_int_equal(prepared.fragments, covered);
    assert_int_equal(prepared.vertices, 3 * sb_scene_triangles(&scene));
    assert_int_equal(prepared.input_hash, sb_scene_hash(&scene));
    sb_scene_free(&scene);
    sb_image_free(&colour);
    sb_image_free(&id);
    fns->release(runner, 1);
    job_free(&it);
}

static void both_storages_draw_the_same_picture_bit_for_bit(void **state)
{
    (void)state;
    struct text_job uniform, block;
    struct sb_prepared prepared[2];
    struct sb_image a, b;
    lit_init(&uniform, 1, false);
    lit_init(&block, 2, true);
    prepare(&uniform, &prepared[0]);
    prepare(&block, &prepared[1]);
    image_of(1, SB_IMAGE_COLOUR, &a);
    image_of(2, SB_IMAGE_COLOUR, &b);
    assert_int_equal(differing(&a, &b), 0);
    assert_int_equal(prepared[0].input_hash, prepared[1].input_hash);
    sb_image_free(&a);
    sb_image_free(&b);
    fns->release(runner, 1);
    fns->release(runner, 2);
    job_free(&uniform);
    job_free(&block);
}

static void a_light_that_is_off_changes_the_picture_and_comes_back(void **state)
{
    (void)state;
    for (int block = 0; block < 2; block++) {
        struct text_job it;
        struct sb_prepared prepared;
        struct sb_error err = {0};
        struct sb_image before, after, without[POINTS];
        lit_init(&it, 1, block);
        prepare(&it, &prepared);
        image_of(1, SB_IMAGE_COLOUR, &before);
        for (int i = 0; i < POINTS; i++) {
            const struct sb_image_request request = {
                .job = 1, .off_first = i, .off_count = 1};
            assert_true(fns->image(runner, &request, &without[i], &err));
            assert_true(differing(&before, &without[i]) > 0);
            if (i > 0)
                assert_true(differing(&without[i], &without[i - 1]) > 0);
        }
        image_of(1, SB_IMAGE_COLOUR, &after);
        assert_int_equal(differing(&before, &after), 0);
        for (int i = 0; i < POINTS; i++)
            sb_image_free(&without[i]);
        sb_image_free(&before);
        sb_image_free(&after);
        fns->release(runner, 1);
        job_free(&it);
    }
}

static void layers_and_rounds_leave_the_picture_as_it_was(void **state)
{
    (void)state;
    struct text_job one, three;
    struct sb_prepared prepared[2];
    struct sb_sample sample[2];
    struct sb_error err = {0};
    struct sb_image a, b, c;
    lit_init(&one, 1, false);
    lit_init(&three, 2, false);
    sb_variant_put(&three.job.variant, SB_AXIS_LAYERS, 3);
    prepare(&one, &prepared[0]);
    prepare(&three, &prepared[1]);
    image_of(1, SB_IMAGE_COLOUR, &a);
    image_of(2, SB_IMAGE_COLOUR, &b);
    const struct sb_shot shots[] = {{1, 5, 1}, {2, 2, 2}};
    assert_true(fns->round(runner, shots, 2, sample, &err));
    image_of(1, SB_IMAGE_COLOUR, &c);
    assert_int_equal(differing(&a, &b), 0);
    assert_int_equal(differing(&a, &c), 0);
    assert_int_equal(prepared[1].fragments, 3 * prepared[0].fragments);
    assert_int_equal(prepared[1].vertices, 3 * prepared[0].vertices);
    assert_true(prepared[1].gl_calls > prepared[0].gl_calls);
    sb_image_free(&a);
    sb_image_free(&b);
    sb_image_free(&c);
    fns->release(runner, 1);
    fns->release(runner, 2);
    job_free(&one);
    job_free(&three);
}

static void a_picture_of_another_size_or_wider_format_leaves_the_job_alone(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_error err = {0};
    struct sb_image own, small, wide, again;
    job_init(&it, 1, flat);
    sb_variant_put(&it.job.variant, SB_AXIS_TARGET, SB_TARGET_RGBA8);
    prepare(&it, &prepared);
    image_of(1, SB_IMAGE_COLOUR, &own);
    const struct sb_image_request request = {.job = 1, .width = 24, .height = 48};
    assert_true(fns->image(runner, &request, &small, &err));
    assert_int_equal(small.width, 24);
    assert_int_equal(small.height, 48);
    const struct sb_image_request unclamped = {.job = 1, .wide = true};
    assert_true(fns->image(runner, &unclamped, &wide, &err));
    image_of(1, SB_IMAGE_COLOUR, &again);
    assert_int_equal(differing(&own, &again), 0);
    const int middle = SIZE / 2;
    check_close(sb_image_at(&own, middle, middle)[0], 1, 0);
    check_close(sb_image_at(&own, middle, middle)[2], 0, 0);
    check_close(sb_image_at(&wide, middle, middle)[0], 2, 0);
    check_close(sb_image_at(&wide, middle, middle)[2], -1, 0);
    check_close(sb_image_at(&small, 12, 24)[0], 1, 0);
    sb_image_free(&own);
    sb_image_free(&small);
    sb_image_free(&wide);
    sb_image_free(&again);
    fns->release(runner, 1);
    job_free(&it);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_colour_is_exact_and_covers_what_the_ids_cover),
        cmocka_unit_test(both_storages_draw_the_same_picture_bit_for_bit),
        cmocka_unit_test(a_light_that_is_off_changes_the_picture_and_comes_back),
        cmocka_unit_test(layers_and_rounds_leave_the_picture_as_it_was),
        cmocka_unit_test(a_picture_of_another_size_or_wider_format_leaves_the_job_alone),
    };
    return run_with_runner(tests, sizeof tests / sizeof *tests);
}
