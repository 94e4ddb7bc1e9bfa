// Whatever programs a policy makes, the picture is that of the program for all scenes; and each
// effect is there for a reason.
#include "assemble_words.h"
#include "gl_test.h"
#include "local/local.h"
#include "measure/check.h"

#include <math.h>

static void *runner;
static struct sb_caps caps;
static const struct sb_runner_fns *const fns = &sb_runner_local;
enum { SIZE = 96 };

static const struct scene {
    const char *name, *words;
} scenes[] = {
    {"night", "dir=1 sun=120 point=1"},
    {"flashlight", "spot=1"},
    {"lamps4", "point=4"},
    {"lamps64", "point=64 attenuation=windowed"},
    {"mixed", "dir=1 point=4"},
    {"partly_mapped", "point=2 maps=diffuse+specular+normal"},
    {"one_caster", "point=3 shadows=1 attenuation=radius"},
    {"containers", "dir=1 point=4 spot=1 maps=diffuse+specular ambient=per_light"},
    {"plane", "point=16 attenuation=radius"},
    {"sphere", "dir=1 point=2 area=1"},
    {"room", "point=2 shadows=2"},
    {"tunnel", "point=1 spot=1 cone=hard"},
    {"blocks", "dir=1 sun=100 point=3"},
    {"spheres", "point=8 area=1 area_shape=tube"},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

// The suite of all of these scenes, which a program for all of them covers.
static struct sb_suite suite;
static struct sb_plan_entry entries[SCENES];

static void words_of(const struct scene *scene, const char *more, char all[512])
{
    snprintf(all, 512, "%swidth=%d height=%d target=rgba32f tessellation=600 %s %s",
             caps.gles ? "api=gles " : "", SIZE, SIZE, scene->words, more);
}

static void make_suite(void)
{
    char all[512];
    suite = (struct sb_suite){.axes = *sb_axes_builtin(), .entry = entries};
    for (int i = 0; i < SCENES; i++) {
        words_of(&scenes[i], "", all);
        entries[i].scene = scenes[i].name;
        variant_of_words(&suite.axes, all, &entries[i].variant);
    }
    suite.entry_count = SCENES;
}

static void prepare(const struct scene *scene, const char *words,
                    struct sb_prepared *prepared)
{
    struct sb_assembly assembly = {0};
    struct sb_variant variant;
    struct sb_error err = {0};
    char all[512];
    words_of(scene, words, all);
    variant_of_words(&suite.axes, all, &variant);
    const struct sb_assemble_params params = {
        .data_dir = SB_SOURCE_DIR,
        .axes = &suite.axes,
        .suite = &suite,
        .scene = scene->name,
        .variant = &variant,
        .caps = &caps,
        .id = 1,
    };
    if (!sb_assemble(&params, &assembly, &err))
        fail_msg("%s: %s: %s", scene->name, all, err.text);
    if (!fns->prepare(runner, &assembly.job, prepared))
        fail_msg("%s: %s: %s\n%s", scene->name, all, prepared->error.text,
                 prepared->log ? prepared->log : "");
    sb_assembly_free(&assembly);
}

static struct sb_prepared draw(const struct scene *scene, const char *words,
                               struct sb_image *image)
{
    struct sb_prepared prepared;
    struct sb_error err = {0};
    const struct sb_image_request request = {.job = 1};
    prepare(scene, words, &prepared);
    if (!fns->image(runner, &request, image, &err))
        fail_msg("%s: %s: %s", scene->name, words, err.text);
    assert_int_equal(sb_image_count_nonfinite(image), 0);
    fns->release(runner, 1);
    return prepared;
}

static double difference(const struct sb_image *a, const struct sb_image *b)
{
    struct sb_image_difference found;
    sb_image_compare(a, b, &found);
    return found.max;
}

// --- the same picture ----------------------------------------------------------------------

static const char *const policies[] = {
    "specialise=uber loop=dynamic",
    "specialise=uber loop=padded",
    "specialise=scene",
    "specialise=object",
    "specialise=object loop=unrolled",
    "specialise=object loop=dynamic bucket=pow2",
    "specialise=object loop=padded bucket=zero_one_many",
    "specialise=scene loop=padded bucket=pow2",
};
enum { POLICIES = sizeof policies / sizeof *policies };

// By 1/1024 at most, where the policy looks at what reaches a draw; else by rounding.
static double allowed(const char *policy)
{
    return strstr(policy, "uber") ? SB_CLASS_BOUND : SB_CLASS_BOUND + 1.0 / 1024;
}

static void check_policies(const struct scene *scene, const char *more)
{
    struct sb_image whole = {0};
    draw(scene, more, &whole);
    for (int i = 0; i < POLICIES; i++) {
        struct sb_image image = {0};
        char words[256];
        snprintf(words, sizeof words, "%s %s", policies[i], more);
        draw(scene, words, &image);
        if (difference(&whole, &image) > allowed(policies[i]))
            fail_msg("%s, %s: differs by %g", scene->name, words,
                     difference(&whole, &image));
        sb_image_free(&image);
    }
    sb_image_free(&whole);
}

static void every_policy_draws_the_picture_of_every_scene(void **state)
{
    (void)state;
    for (int i = 0; i < SCENES; i++)
        check_policies(&scenes[i], "");
}

static void so_it_does_with_other_storages_stages_and_spaces(void **state)
{
    (void)state;
    check_policies(&scenes[3], "storage=ubo_std140");
    check_policies(&scenes[4], "storage=arrays space=view");
    check_policies(&scenes[7], "stage=vertex");
    check_policies(&scenes[5], "f_frame=naive");
    check_policies(&scenes[6], "storage=ubo_std140 shadow_map=array2d");
    check_policies(&scenes[7], "hoist=per_light guard=mask layers=2");
    check_policies(&scenes[4], "update=lights lamps=on");
}

static void a_larger_threshold_leaves_out_more_and_keeps_its_word(void **state)
{
    (void)state;
    static const struct scene scene = {"lamps64", "point=64"}; // that never quite end
    struct sb_image whole = {0}, image = {0};
    draw(&scene, "", &whole);
    draw(&scene, "specialise=object threshold=0.1", &image);
    const double found = difference(&whole, &image);
    assert_true(found > 1.0 / 1024); // it does leave out
    assert_true(found <= 0.1 + SB_CLASS_BOUND);
    sb_image_free(&image);
    draw(&scene, "specialise=object threshold=0", &image);
    assert_true(difference(&whole, &image) <= SB_CLASS_BOUND);
    sb_image_free(&image);
    sb_image_free(&whole);
}

// A job of several programs after another one, and twice: nothing of one is left in the next.
static void policies_leave_each_other_alone(void **state)
{
    (void)state;
    struct sb_image first = {0}, again = {0}, other = {0};
    draw(&scenes[6], "specialise=object", &first);
    draw(&scenes[4], "specialise=uber loop=dynamic", &other);
    draw(&scenes[6], "specialise=object", &again);
    assert_true(difference(&first, &again) == 0);
    sb_image_free(&first);
    sb_image_free(&again);
    sb_image_free(&other);
}

// --- lights can be told apart ---------------------------------------------------------------

static void a_light_that_is_off_is_off_in_all_programs(void **state)
{
    (void)state;
    struct sb_prepared prepared;
    struct sb_error err = {0};
    for (int p = 0; p < 2; p++) {
        struct sb_image image[2] = {{0}};
        for (int i = 0; i < 2; i++) {
            const struct sb_image_request request = {
                .job = 1, .off_first = 2, .off_count = 2};
            prepare(&scenes[4],
                    i == 0 ? ""
                           : (p ? "specialise=object storage=ubo_std140"
                                : "specialise=object"),
                    &prepared);
            assert_true(fns->image(runner, &request, &image[i], &err));
            fns->release(runner, 1);
        }
        assert_true(difference(&image[0], &image[1]) < 1.0 / 1024 + SB_CLASS_BOUND);
        sb_image_free(&image[0]);
        sb_image_free(&image[1]);
    }
}

// --- programs -------------------------------------------------------------------------------

static void equal_draws_share_a_program(void **state)
{
    (void)state;
    struct sb_image image = {0};
    struct sb_prepared prepared = draw(&scenes[4], "specialise=object", &image);
    assert_in_range(prepared.programs, 2, 4); // matte and glossy, flat and round
    assert_int_equal(prepared.switches, prepared.programs - 1);
    sb_image_free(&image);
    prepared = draw(&scenes[3], "specialise=object loop=dynamic bucket=pow2", &image);
    assert_in_range(prepared.programs, 2, 10); // of 80 draws
    sb_image_free(&image);
    prepared = draw(&scenes[4], "specialise=scene layers=3", &image);
    assert_int_equal(prepared.programs, 1);
    assert_int_equal(prepared.switches, 0);
    sb_image_free(&image);
}

// --- each effect is there for a reason --------------------------------------------------------

static const struct reason {
    int scene;
    const char *more, *effect;
} reasons[] = {
    {4, "", "dir"},
    {4, "", "point"},
    {1, "", "spot"},
    {9, "", "area"},
    {4, "", "ambient"},
    {4, "", "diffuse"},
    {4, "", "specular"},
    {4, "fresnel=schlick", "fresnel"},
    {2, "", "attenuation"},
    {1, "", "cone"},
    {5, "", "diffuse_map"},
    {5, "", "specular_map"},
    {5, "", "normal_map"},
    {6, "", "shadows"},
    {9, "tessellation=200", "renormalise"},
};

// So a test that wrongly left it out would be found by the pictures above.
static void without_an_effect_the_picture_is_another(void **state)
{
    (void)state;
    static const char *const how[] = {"", "specialise=scene", "specialise=object",
                                      "specialise=uber loop=dynamic"};
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++) {
        const struct reason *reason = &reasons[i];
        struct sb_image first = {0};
        for (int p = 0; p < 4; p++) {
            struct sb_image whole = {0}, less = {0};
            char words[256];
            snprintf(words, sizeof words, "%s %s", how[p], reason->more);
            draw(&scenes[reason->scene], words, &whole);
            snprintf(words, sizeof words, "%s %s without=%s", how[p], reason->more,
                     reason->effect);
            draw(&scenes[reason->scene], words, &less);
            if (!(difference(&whole, &less) > 2.0 / 1024))
                fail_msg("%s: %s changes the picture by %g only",
                         scenes[reason->scene].name, words, difference(&whole, &less));
            sb_image_free(&whole);
            if (p == 0) {
                first = less;
                continue;
            }
            // And it is the same other picture, whatever the policy.
            if (difference(&first, &less) > allowed(how[p]))
                fail_msg("%s: %s differs by %g", scenes[reason->scene].name, words,
                         difference(&first, &less));
            sb_image_free(&less);
        }
        sb_image_free(&first);
    }
}

int main(void)
{
    struct sb_error err = {0};
    const struct sb_context_params params = {
        .context = gl_test_context(), .gles = gl_test_gles(), .device = -1};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_policy_draws_the_picture_of_every_scene),
        cmocka_unit_test(so_it_does_with_other_storages_stages_and_spaces),
        cmocka_unit_test(a_larger_threshold_leaves_out_more_and_keeps_its_word),
        cmocka_unit_test(policies_leave_each_other_alone),
        cmocka_unit_test(a_light_that_is_off_is_off_in_all_programs),
        cmocka_unit_test(equal_draws_share_a_program),
        cmocka_unit_test(without_an_effect_the_picture_is_another),
    };
    runner = fns->open(&params, &caps, &err);
    if (!runner)
        gl_test_unavailable(&err);
    make_suite();
    const int failed = run_tests(tests);
    fns->close(runner);
    return failed;
}
