// Shadows through the runner: whole jobs of a shipped scene.
#include "assemble_words.h"
#include "gl_test.h"
#include "local/local.h"

static void *runner;
static struct sb_caps caps;
static const struct sb_runner_fns *const fns = &sb_runner_local;

// False where the driver has no such thing.
static bool assemble_here(const char *words, uint32_t id, struct sb_assembly *assembly)
{
    struct sb_variant variant;
    struct sb_error err = {0};
    char all[400];
    snprintf(all, sizeof all,
             "%spoint=3 shadows=2 shadow_size=128 width=64 height=64 target=rgba32f %s",
             caps.gles ? "api=gles " : "", words);
    variant_of_words(sb_axes_builtin(), all, &variant);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = sb_axes_builtin(),
        .scene = "containers",
        .variant = &variant,
        .caps = &caps,
        .id = id,
    };
    *assembly = (struct sb_assembly){0};
    if (sb_assemble(&params, assembly, &err))
        return true;
    sb_assembly_free(assembly);
    if (err.status != SB_OVER_LIMIT)
        fail_msg("%s: %s", all, err.text);
    return false;
}

static bool prepare(const char *words, uint32_t id, struct sb_prepared *prepared)
{
    struct sb_assembly assembly;
    if (!assemble_here(words, id, &assembly))
        return false;
    if (!fns->prepare(runner, &assembly.job, prepared))
        fail_msg("%s: %s", words, prepared->error.text);
    sb_assembly_free(&assembly);
    return true;
}

static void image_of(uint32_t id, enum sb_image_kind kind, int caster,
                     struct sb_image *image)
{
    struct sb_error err = {0};
    const struct sb_image_request request = {.job = id, .kind = kind, .caster = caster};
    if (!fns->image(runner, &request, image, &err))
        fail_msg("%s", err.text);
}

// Prepares, draws, and releases.
static bool draw(const char *words, enum sb_image_kind kind, struct sb_image *image)
{
    struct sb_prepared prepared;
    if (!prepare(words, 1, &prepared))
        return false;
    image_of(1, kind, 0, image);
    fns->release(runner, 1);
    return true;
}

static struct sb_image_difference compare(const struct sb_image *a,
                                          const struct sb_image *b)
{
    struct sb_image_difference difference;
    sb_image_compare(a, b, &difference);
    return difference;
}

static void every_way_to_keep_and_draw_the_maps_makes_the_same_picture(void **state)
{
    (void)state;
    static const char *const ways[] = {
        "shadow_map=six2d",
        "shadow_map=array2d",
        "shadow_map=cube_array",
        "shadow_map=array2d shadow_pass=layered",
        "shadow_map=cube shadow_pass=layered",
        "shadow_map=cube_array shadow_pass=layered",
        "shadow_map=six2d space=view storage=ubo_std140",
        "shadow_map=array2d loop=unrolled storage=arrays",
        "shadow_map=cube update=lights+shadows",
    };
    struct sb_image want, unlit;
    draw("shadow_map=cube", SB_IMAGE_COLOUR, &want);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct sb_image got;
        if (!draw(ways[i], SB_IMAGE_COLOUR, &got))
            continue;
        const struct sb_image_difference difference = compare(&want, &got);
        if (difference.max > 1e-4)
            fail_msg("%s: pixel %d, %d differs by %g", ways[i], difference.x,
                     difference.y, difference.max);
        sb_image_free(&got);
    }
    // The shadows are there at all.
    draw("shadows=0", SB_IMAGE_COLOUR, &unlit);
    assert_true(compare(&want, &unlit).pixels > 50);
    sb_image_free(&unlit);
    sb_image_free(&want);
}

static void every_kind_shows_the_same_unfolded_map(void **state)
{
    (void)state;
    static const char *const ways[] = {"shadow_map=six2d", "shadow_map=array2d",
                                       "shadow_map=cube_array",
                                       "shadow_map=cube shadow_pass=layered", "lamps=on"};
    struct sb_image want;
    draw("shadow_map=cube", SB_IMAGE_SHADOW, &want);
    assert_int_equal(want.width, 4 * 128);
    assert_int_equal(want.height, 3 * 128);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct sb_image got;
        if (!draw(ways[i], SB_IMAGE_SHADOW, &got))
            continue;
        // A pixel on the outline of a box may fall on either side of it.
        const struct sb_image_difference difference = compare(&want, &got);
        long far = 0;
        for (long p = 0; p < (long)want.width * want.height; p++)
            far += fabsf(want.data[p] - got.data[p]) > 1e-5f;
        if (far > 200)
            fail_msg("%s: %ld texels differ, by up to %g", ways[i], far, difference.max);
        sb_image_free(&got);
    }
    sb_image_free(&want);
}

static void maps_are_drawn_in_a_frame_only_where_casters_move(void **state)
{
    (void)state;
    struct sb_prepared still, lit, moving;
    assert_true(prepare("", 1, &still));
    assert_true(prepare("update=lights", 2, &lit));
    assert_true(prepare("update=lights+shadows", 3, &moving));
    // Of each of 2 casters 6 faces, and in each a draw of 10 boxes at least.
    assert_true(moving.gl_calls - lit.gl_calls > 2 * 6 * 10);
    assert_true(lit.gl_calls - still.gl_calls < 2 * 6 * 10);
    assert_int_equal(lit.vertices, still.vertices);
    assert_int_equal(moving.vertices, still.vertices + 2 * 6 * still.vertices);
    for (uint32_t id = 1; id <= 3; id++)
        fns->release(runner, id);
}

static void moving_casters_leave_the_picture_of_the_scene_as_it_is(void **state)
{
    (void)state;
    static const enum sb_image_kind kinds[] = {SB_IMAGE_COLOUR, SB_IMAGE_SHADOW};
    struct sb_prepared prepared;
    struct sb_sample sample;
    struct sb_error err = {0};
    const struct sb_shot shot = {.job = 2, .frames = 3, .shrink = 1};
    assert_true(prepare("", 1, &prepared));
    assert_true(prepare("update=lights+shadows", 2, &prepared));
    for (int k = 0; k < 2; k++) {
        struct sb_image want, got;
        image_of(1, kinds[k], 1, &want);
        assert_true(fns->round(runner, &shot, 1, &sample, &err));
        image_of(2, kinds[k], 1, &got);
        assert_true(compare(&want, &got).max <= 1e-6);
        sb_image_free(&want);
        sb_image_free(&got);
    }
    fns->release(runner, 1);
    fns->release(runner, 2);
}

static void the_shadow_passes_alone_can_be_timed_where_frames_draw_them(void **state)
{
    (void)state;
    static const char *const stores[] = {"r8", "r32f", "depth"};
    struct sb_prepared prepared;
    struct sb_sample sample;
    struct sb_error err = {0};
    struct sb_shot shot = {.job = 1, .frames = 2, .shrink = 1, .part = SB_PART_SHADOWS};
    for (int i = 0; i < 3; i++) {
        char words[80];
        snprintf(words, sizeof words, "update=lights+shadows shadow_store=%s", stores[i]);
        if (!prepare(words, 1, &prepared))
            continue;
        if (!fns->round(runner, &shot, 1, &sample, &err))
            fail_msg("%s: %s", words, err.text);
        assert_true(sample.wall_ns > 0);
        fns->release(runner, 1);
    }
    assert_true(prepare("", 1, &prepared));
    assert_false(fns->round(runner, &shot, 1, &sample, &err));
    check_contains(err.text, "frames draw no shadow maps");
    fns->release(runner, 1);
}

static void sixteen_casters_are_drawn_in_arrays_and_refused_in_six2d(void **state)
{
    (void)state;
    static const char *const arrays[] = {"array2d", "cube_array"};
    struct sb_assembly assembly;
    const char *few = "point=16 shadows=16 shadow_size=16 shadow_map=";
    char words[100];
    snprintf(words, sizeof words, "%ssix2d", few);
    assert_int_equal(assemble_here(words, 1, &assembly), caps.texture_units >= 96);
    for (int i = 0; i < 2; i++) {
        struct sb_image image;
        snprintf(words, sizeof words, "%s%s", few, arrays[i]);
        if (!draw(words, SB_IMAGE_COLOUR, &image))
            continue;
        assert_int_equal(sb_image_count_nonfinite(&image), 0);
        sb_image_free(&image);
    }
}

int main(void)
{
    struct sb_error err = {0};
    const struct sb_context_params params = {
        .context = gl_test_context(), .gles = gl_test_gles(), .device = -1};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_to_keep_and_draw_the_maps_makes_the_same_picture),
        cmocka_unit_test(every_kind_shows_the_same_unfolded_map),
        cmocka_unit_test(maps_are_drawn_in_a_frame_only_where_casters_move),
        cmocka_unit_test(moving_casters_leave_the_picture_of_the_scene_as_it_is),
        cmocka_unit_test(the_shadow_passes_alone_can_be_timed_where_frames_draw_them),
        cmocka_unit_test(sixteen_casters_are_drawn_in_arrays_and_refused_in_six2d),
    };
    runner = fns->open(&params, &caps, &err);
    if (!runner)
        gl_test_unavailable(&err);
    const int failed = run_tests(tests);
    fns->close(runner);
    return failed;
}
