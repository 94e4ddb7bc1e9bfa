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

static void every_storage_draws_the_same_picture_bit_for_bit(void **state)
{
    (void)state;
    struct sb_prepared first;
    struct sb_image a = {0};
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        struct text_job it;
        struct sb_prepared prepared;
        struct sb_image b;
        lit_init(&it, 1, storage);
        prepare(&it, &prepared);
        image_of(1, SB_IMAGE_COLOUR, storage == 0 ? &a : &b);
        if (storage == 0) {
            first = prepared;
        } else {
            assert_int_equal(differing(&a, &b), 0);
            assert_int_equal(prepared.input_hash, first.input_hash);
            sb_image_free(&b);
        }
        fns->release(runner, 1);
        job_free(&it);
    }
    sb_image_free(&a);
}

static void a_light_that_is_off_changes_the_picture_and_comes_back(void **state)
{
    (void)state;
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        struct text_job it;
        struct sb_prepared prepared;
        struct sb_error err = {0};
        struct sb_image before, after, without[POINTS];
        lit_init(&it, 1, storage);
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

// Pictures show the scene's own lights, wherever a batch has left them.
static void lights_that_move_stand_still_in_pictures(void **state)
{
    (void)state;
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        struct text_job still, moving;
        struct sb_prepared prepared[2];
        struct sb_sample sample;
        struct sb_error err = {0};
        struct sb_image want, got;
        lit_init(&still, 1, storage);
        lit_init(&moving, 2, storage);
        sb_variant_put(&moving.job.variant, SB_AXIS_UPDATE, SB_UPDATE_LIGHTS);
        prepare(&still, &prepared[0]);
        prepare(&moving, &prepared[1]);
        assert_true(prepared[1].gl_calls > prepared[0].gl_calls);
        image_of(1, SB_IMAGE_COLOUR, &want);
        image_of(2, SB_IMAGE_COLOUR, &got);
        assert_int_equal(differing(&want, &got), 0);
        sb_image_free(&got);
        for (int frames = 1; frames <= SB_PHASES + 1; frames++) {
            const struct sb_shot shot = {2, frames, 1, SB_PART_WHOLE};
            assert_true(fns->round(runner, &shot, 1, &sample, &err));
            image_of(2, SB_IMAGE_COLOUR, &got);
            assert_int_equal(differing(&want, &got), 0);
            sb_image_free(&got);
        }
        sb_image_free(&want);
        fns->release(runner, 1);
        fns->release(runner, 2);
        job_free(&still);
        job_free(&moving);
    }
}

// What of a lamp's cube is seen has the colour of its light, and is not lit.
static void lamps_are_drawn_unlit_by_the_program_of_their_role(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_image colour, id;
    struct sb_scene scene = {0};
    struct sb_error err = {0};
    static const float lit[4] = {2, 0.25f, -1, 0.5f};
    job_init(&it, 1, flat);
    job_add_lamp(&it, lamp);
    it.job.scene = "plane";
    prepare(&it, &prepared);
    image_of(1, SB_IMAGE_COLOUR, &colour);
    image_of(1, SB_IMAGE_ID, &id);
    assert_true(sb_scene_make("plane", &it.job.variant, &scene, &err));
    int points;
    const struct sb_light *point = sb_lights_of(&scene.lights, SB_LIGHT_POINT, &points);
    long of_lamps = 0, of_cubes = 0;
    for (long i = 0; i < SIZE * SIZE; i++) {
        const int number = (int)id.data[i] - 1;
        if (number < 0)
            continue;
        const int lamp_of = scene.draw[number].lamp;
        const float *want = lamp_of < 0 ? lit : point[lamp_of].diffuse;
        assert_memory_equal(&colour.data[4 * i], want, 3 * sizeof *want);
        of_lamps += lamp_of >= 0;
        of_cubes += lamp_of < 0;
    }
    if (of_lamps == 0 || of_cubes == 0)
        fail_msg("%ld pixels of lamps, %ld of cubes", of_lamps, of_cubes);
    sb_scene_free(&scene);
    sb_image_free(&colour);
    sb_image_free(&id);
    fns->release(runner, 1);
    job_free(&it);
}

static void several_samples_change_edges_alone_and_neither_ids_nor_counts(void **state)
{
    (void)state;
    struct text_job one, four;
    struct sb_prepared prepared[2];
    struct sb_image a, b, id_a, id_b;
    if (caps.samples < 4)
        skip();
    job_init(&one, 1, flat);
    job_init(&four, 2, flat);
    sb_variant_put(&four.job.variant, SB_AXIS_SAMPLES, 4);
    prepare(&one, &prepared[0]);
    if (!fns->prepare(runner, &four.job, &prepared[1])) {
        assert_int_equal(prepared[1].error.status, SB_OVER_LIMIT);
        skip(); // no such floats with samples
    }
    image_of(1, SB_IMAGE_COLOUR, &a);
    image_of(2, SB_IMAGE_COLOUR, &b);
    image_of(1, SB_IMAGE_ID, &id_a);
    image_of(2, SB_IMAGE_ID, &id_b);
    assert_int_equal(differing(&id_a, &id_b), 0);
    assert_int_equal(prepared[0].fragments, prepared[1].fragments);
    assert_int_equal(prepared[0].gl_calls + 3, prepared[1].gl_calls);
    long mixed = 0;
    for (int y = 1; y < SIZE - 1; y++) {
        for (int x = 1; x < SIZE - 1; x++) {
            bool edge = false;
            for (int n = 0; n < 9; n++)
                edge |= *sb_image_at(&id_a, x + n % 3 - 1, y + n / 3 - 1) !=
                        *sb_image_at(&id_a, x, y);
            const bool same =
                !memcmp(sb_image_at(&a, x, y), sb_image_at(&b, x, y), 4 * sizeof(float));
            assert_true(same || edge);
            mixed += !same;
        }
    }
    assert_true(mixed > 0);
    sb_image_free(&a);
    sb_image_free(&b);
    sb_image_free(&id_a);
    sb_image_free(&id_b);
    fns->release(runner, 1);
    fns->release(runner, 2);
    job_free(&one);
    job_free(&four);
}

static void layers_and_rounds_leave_the_picture_as_it_was(void **state)
{
    (void)state;
    struct text_job one, three;
    struct sb_prepared prepared[2];
    struct sb_sample sample[2];
    struct sb_error err = {0};
    struct sb_image a, b, c;
    lit_init(&one, 1, AS_UNIFORMS);
    lit_init(&three, 2, AS_UNIFORMS);
    sb_variant_put(&three.job.variant, SB_AXIS_LAYERS, 3);
    prepare(&one, &prepared[0]);
    prepare(&three, &prepared[1]);
    image_of(1, SB_IMAGE_COLOUR, &a);
    image_of(2, SB_IMAGE_COLOUR, &b);
    const struct sb_shot shots[] = {{1, 5, 1, SB_PART_WHOLE}, {2, 2, 2, SB_PART_WHOLE}};
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
        cmocka_unit_test(every_storage_draws_the_same_picture_bit_for_bit),
        cmocka_unit_test(a_light_that_is_off_changes_the_picture_and_comes_back),
        cmocka_unit_test(lights_that_move_stand_still_in_pictures),
        cmocka_unit_test(lamps_are_drawn_unlit_by_the_program_of_their_role),
        cmocka_unit_test(several_samples_change_edges_alone_and_neither_ids_nor_counts),
        cmocka_unit_test(layers_and_rounds_leave_the_picture_as_it_was),
        cmocka_unit_test(a_picture_of_another_size_or_wider_format_leaves_the_job_alone),
    };
    return run_with_runner(tests, sizeof tests / sizeof *tests);
}
