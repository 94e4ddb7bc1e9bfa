// What the source texts ask of a driver, through the runner and with the shipped shaders: calls
// that an upload takes, many lights, GLSL ES 1.00, the sun at night.
#include "assemble_words.h"
#include "gl_test.h"
#include "local/local.h"

static void *runner;
static struct sb_caps caps;
static const struct sb_runner_fns *const fns = &sb_runner_local;
enum { SIZE = 48 };

// Prepares it under this number. False where the driver has no such thing.
static bool prepare(const char *scene, const char *words, uint32_t id,
                    struct sb_prepared *prepared)
{
    struct sb_assembly assembly = {0};
    struct sb_variant variant;
    struct sb_error err = {0};
    char all[400];
    snprintf(all, sizeof all, "%swidth=%d height=%d target=rgba32f %s",
             caps.gles ? "api=gles " : "", SIZE, SIZE, words);
    variant_of_words(sb_axes_builtin(), all, &variant);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = sb_axes_builtin(),
        .scene = scene,
        .variant = &variant,
        .caps = &caps,
        .id = id,
    };
    if (!sb_assemble(&params, &assembly, &err)) {
        sb_assembly_free(&assembly);
        if (err.status != SB_OVER_LIMIT)
            fail_msg("%s: %s", all, err.text);
        return false;
    }
    const bool good = fns->prepare(runner, &assembly.job, prepared);
    sb_assembly_free(&assembly);
    if (!good)
        fail_msg("%s: %s\n%s", all, prepared->error.text,
                 prepared->log ? prepared->log : "");
    return true;
}

static void picture(uint32_t id, int off_first, int off_count, struct sb_image *image)
{
    struct sb_error err = {0};
    const struct sb_image_request request = {
        .job = id, .off_first = off_first, .off_count = off_count};
    if (!fns->image(runner, &request, image, &err))
        fail_msg("%s", err.text);
    assert_int_equal(sb_image_count_nonfinite(image), 0);
}

// Prepares, draws, and releases.
static bool draw(const char *scene, const char *words, struct sb_image *image)
{
    struct sb_prepared prepared;
    if (!prepare(scene, words, 1, &prepared))
        return false;
    picture(1, 0, 0, image);
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

// --- uploads ---------------------------------------------------------------------------------

static int64_t calls_of(const char *scene, const char *words)
{
    struct sb_prepared prepared;
    assert_true(prepare(scene, words, 1, &prepared));
    fns->release(runner, 1);
    return prepared.gl_calls;
}

// Calls that a frame makes to upload the lights.
static int64_t upload_calls(const char *storage)
{
    static const char *const updates[] = {"static", "lights"};
    int64_t calls[2];
    for (int i = 0; i < 2; i++) {
        char words[200];
        snprintf(words, sizeof words,
                 "point=4 model=phong ambient=per_light attenuation=polynomial "
                 "storage=%s update=%s",
                 storage, updates[i]);
        calls[i] = calls_of("containers", words);
    }
    return calls[1] - calls[0];
}

// The text of `delphi` counts them: seven members of four lights. Beside them the program is made
// current, or the buffer bound.
static void four_point_lights_take_28_calls_or_7_arrays_or_a_buffer(void **state)
{
    (void)state;
    assert_int_equal(upload_calls("uniform"), 28 + 1);
    assert_int_equal(upload_calls("arrays"), 7 + 1);
    assert_int_equal(upload_calls("ubo_std140"), 1 + 1);
    assert_int_equal(upload_calls("ubo_shared"), 1 + 1);
}

// At night no upload of a sun is left either.
static void at_night_a_frame_is_that_of_no_sun(void **state)
{
    (void)state;
    static const char *const storages[] = {"uniform", "arrays", "ubo_std140"};
    for (int i = 0; i < 3; i++) {
        static const char *const suns[] = {"dir=0", "dir=1 sun=135", "dir=1 sun=90"};
        struct sb_image image[3];
        int64_t calls[3];
        for (int s = 0; s < 3; s++) {
            char words[160];
            snprintf(words, sizeof words, "point=2 update=lights storage=%s %s",
                     storages[i], suns[s]);
            calls[s] = calls_of("blocks", words);
            assert_true(draw("blocks", words, &image[s]));
        }
        assert_int_equal(calls[1], calls[0]);
        assert_true(calls[2] >= calls[0]);
        // At 90 degrees exactly it is seen still.
        check_close(compare(&image[1], &image[0]).max, 0, 0);
        assert_true(compare(&image[2], &image[0]).max > 1e-5);
        for (int s = 0; s < 3; s++)
            sb_image_free(&image[s]);
    }
}

// --- many lights -----------------------------------------------------------------------------

// Every one of them is lit: without any sixteen of them the picture is another.
static void check_many(const char *words, int total)
{
    struct sb_prepared prepared;
    struct sb_image all;
    if (!prepare("room", words, 1, &prepared))
        fail_msg("%s: over a limit of this driver", words);
    picture(1, 0, 0, &all);
    for (int first = 0; first < total; first += 16) {
        struct sb_image without;
        picture(1, first, 16, &without);
        if (compare(&all, &without).max < 1e-6)
            fail_msg("%s: lights %d to %d change nothing", words, first, first + 15);
        sb_image_free(&without);
    }
    sb_image_free(&all);
    fns->release(runner, 1);
}

static void sixty_four_point_lights_are_lit_in_every_storage(void **state)
{
    (void)state;
    // A driver need not have room for so many as plain uniforms; a block of 16 KiB, which every
    // one has, holds them.
    check_many("point=64 storage=auto", 64);
    check_many("point=64 storage=ubo_std140 layout=unified", 64);
    check_many("point=64 storage=ubo_shared loop=dynamic", 64);
    check_many("point=64 storage=ubo_std140 stage=vertex loop=padded", 64);
}

static void two_hundred_and_fifty_six_lights_are_lit_from_a_block(void **state)
{
    (void)state;
    if (caps.uniform_block_size < 65536) {
        print_message("skipped: blocks of %ld bytes\n", (long)caps.uniform_block_size);
        skip();
    }
    check_many("point=256 storage=ubo_std140", 256);
    check_many("point=256 storage=ubo_shared loop=dynamic", 256);
    check_many("dir=64 point=128 spot=64 storage=ubo_std140", 256);
}

static void sixteen_casters_are_lit_and_each_throws_a_shadow(void **state)
{
    (void)state;
    static const char *const kinds[] = {"array2d", "cube_array"};
    struct sb_image unshadowed;
    assert_true(draw("room", "point=16", &unshadowed));
    for (int k = 0; k < 2; k++) {
        struct sb_image before = unshadowed;
        for (int casters = 8; casters <= 16; casters += 8) {
            char words[120];
            struct sb_image image;
            snprintf(words, sizeof words,
                     "point=16 shadows=%d shadow_size=64 shadow_map=%s", casters,
                     kinds[k]);
            if (!draw("room", words, &image))
                continue;
            assert_true(compare(&image, &before).pixels > 10);
            if (before.data != unshadowed.data)
                sb_image_free(&before);
            before = image;
        }
        if (before.data != unshadowed.data)
            sb_image_free(&before);
    }
    sb_image_free(&unshadowed);
}

// --- versions --------------------------------------------------------------------------------

// The text of `wikibooks` says why its loop bound is a constant: #version 100.
static void the_wikibook_draws_alike_in_glsl_es_100(void **state)
{
    (void)state;
    static const char wikibooks[] =
        "point=1 spot=1 model=phong cone=exponent layout=unified storage=global "
        "hoist=per_light";
    char words[200];
    struct sb_image now, then;
    if (!caps.gles)
        skip();
    assert_true(draw("tunnel", wikibooks, &now));
    snprintf(words, sizeof words, "glsl=100 %s", wikibooks);
    assert_true(draw("tunnel", words, &then));
    assert_true(compare(&now, &then).max <= 1e-4);
    sb_image_free(&now);
    sb_image_free(&then);
}

// --- normals ---------------------------------------------------------------------------------

// Between two vertices an interpolated normal is shorter than 1, and so the light weaker.
static void normals_left_as_interpolated_are_too_short(void **state)
{
    (void)state;
    static const char common[] = "dir=2 model=lambert ambient=none tessellation=100";
    char words[160];
    struct sb_image on, off;
    double most = 0;
    assert_true(draw("sphere", common, &on));
    snprintf(words, sizeof words, "%s normalise=off", common);
    assert_true(draw("sphere", words, &off));
    for (int i = 0; i < SIZE * SIZE * 4; i++) {
        assert_true(off.data[i] <= on.data[i] + 1e-6f);
        if (i % 4 != 3 && on.data[i] > 0.1f)
            most = fmax(most, 1 - off.data[i] / on.data[i]);
    }
    // About as much as the chord of a facet of a hundred is below the sphere.
    assert_true(most > 0.02 && most < 0.2);
    sb_image_free(&on);
    sb_image_free(&off);
}

int main(void)
{
    struct sb_error err = {0};
    const struct sb_context_params params = {
        .context = gl_test_context(), .gles = gl_test_gles(), .device = -1};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_point_lights_take_28_calls_or_7_arrays_or_a_buffer),
        cmocka_unit_test(at_night_a_frame_is_that_of_no_sun),
        cmocka_unit_test(sixty_four_point_lights_are_lit_in_every_storage),
        cmocka_unit_test(two_hundred_and_fifty_six_lights_are_lit_from_a_block),
        cmocka_unit_test(sixteen_casters_are_lit_and_each_throws_a_shadow),
        cmocka_unit_test(the_wikibook_draws_alike_in_glsl_es_100),
        cmocka_unit_test(normals_left_as_interpolated_are_too_short),
    };
    runner = fns->open(&params, &caps, &err);
    if (!runner)
        gl_test_unavailable(&err);
    const int failed = run_tests(tests);
    fns->close(runner);
    return failed;
}
