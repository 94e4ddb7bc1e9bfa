// A world far from its origin: what space=eye draws at any offset is what is drawn without one;
// space=world loses it (catalogue of hard cases, "large-world").
#include "accuracy_world.h"

enum { SIDE = 64 };

static void picture_of(const char *scene, const char *words, const char *place,
                       struct sb_image *image)
{
    struct one one;
    struct sb_error err = {0};
    char all[256];
    snprintf(all, sizeof all, "%s,%s", words, place);
    one_make(&one, &(struct one_params){.scene = scene, .words = all});
    const struct sb_image_request request = {
        .job = one.task.assembly.job.id,
        .kind = SB_IMAGE_COLOUR,
        .width = SIDE,
        .height = SIDE,
        .wide = true,
    };
    if (!driver.fns->image(driver.runner, &request, image, &err))
        fail_msg("%s: %s", all, err.text);
    one_free(&one);
}

// The largest difference, in steps of 8 bits.
static double steps_between(const struct sb_image *a, const struct sb_image *b)
{
    struct sb_image_difference difference;
    sb_image_compare(a, b, &difference);
    return 255 * difference.max;
}

static const struct setting {
    const char *scene, *words;
} settings[] = {
    {"containers", "dir=1,point=4,spot=2,lamps=on,update=lights,layout=unified"},
    {"spheres", "point=3,stage=vertex,hoist=per_light,storage=constant"},
    {"tunnel", "area=2,area_shape=box,scale=4"},
    {"room", "point=2,shadows=2,shadow_size=64"},
};
enum { SETTINGS = sizeof settings / sizeof *settings };

static void the_origin_at_the_eye_keeps_what_the_origin_of_the_world_loses(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        bool kept;
    } places[] = {
        {"space=eye,offset=1e6", true},
        {"space=eye,offset=1e9", true},
        {"space=world,offset=1e6", false},
    };
    for (int i = 0; i < SETTINGS; i++) {
        const struct setting *it = &settings[i];
        struct sb_image wanted = {0}, got = {0};
        picture_of(it->scene, it->words, "offset=0", &wanted);
        for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
            picture_of(it->scene, it->words, places[p].words, &got);
            const double steps = steps_between(&got, &wanted);
            if ((steps <= 0.5) != places[p].kept)
                fail_msg("%s %s %s: %g / 255", it->scene, it->words, places[p].words,
                         steps);
            sb_image_free(&got);
        }
        sb_image_free(&wanted);
    }
}

// The reference has the floats of the variant, shadows and moving lights among them.
static void the_reference_agrees_at_any_offset(void **state)
{
    (void)state;
    for (int i = 0; i < SETTINGS; i++) {
        struct one one;
        char all[256];
        snprintf(all, sizeof all, "%s,width=64,height=64,target=rgba32f,%s",
                 settings[i].words, "space=eye,offset=1e9");
        one_measure(&one, &(struct one_params){.scene = settings[i].scene, .words = all});
        const struct sb_split *split = &one.task.accuracy.split;
        if (!(split->part[SB_BY_ARITHMETIC].max <= 2e-5) ||
            split->compared <= 9 * split->mismatched)
            fail_msg("%s %s: %g; %ld pixels compared, %ld not", settings[i].scene, all,
                     split->part[SB_BY_ARITHMETIC].max, (long)split->compared,
                     (long)split->mismatched);
        one_free(&one);
    }
}

int main(void)
{
    open_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_origin_at_the_eye_keeps_what_the_origin_of_the_world_loses),
        cmocka_unit_test(the_reference_agrees_at_any_offset),
    };
    const int failed = run_tests(tests);
    sb_driver_close(&driver);
    return failed;
}
