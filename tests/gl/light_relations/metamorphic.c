// What must stay the same when lights are put otherwise.
#include "relations.h"

// Two of each type, none like another.
static void setting_make(struct setting *setting)
{
    setting_init(setting);
    for (int i = 0; i < 8; i++) {
        struct sb_light light = light_at(-1.5 + 0.4 * i, i % 3 - 1, 0.5 + 0.1 * i);
        for (int c = 0; c < 3; c++) {
            light.ambient[c] = ldexpf((float)(1 + i), -5);
            light.diffuse[c] = ldexpf((float)(8 - i), -4);
            light.specular[c] = ldexpf((float)(3 + i), -4);
        }
        light.radius = 0.25f;
        light.direction[0] = ldexpf((float)(i - 4), -4);
        if (i / 2 == SB_LIGHT_SPOT) { // of unit length
            light.direction[0] = 0;
            light.direction[1] = i % 2 ? 0.6f : -0.6f;
            light.direction[2] = -0.8f;
        }
        setting_add(setting, (enum sb_light_type)(i / 2), light);
    }
}

static const char *const words[] = {
    "ambient=per_light",
    "ambient=per_light stage=vertex model=phong area_shape=capsule",
    "ambient=per_light space=view attenuation=windowed storage=ubo_std140 cone=linear",
    "ambient=per_light loop=dynamic storage=arrays area_shape=tube specular_side=both",
};
enum { WORDS = sizeof words / sizeof *words };

void the_order_of_lights_does_not_matter(void **state)
{
    (void)state;
    struct setting there, back;
    setting_make(&there);
    back = there;
    for (int i = 0; i < 8; i++)
        back.light[i] = there.light[i ^ 1]; // within a type
    for (int i = 0; i < WORDS; i++)
        check_same(&there, words[i], &back, words[i], 1, 2e-6);
}

static void scale_colours(struct sb_light *light, float by)
{
    for (int c = 0; c < 3; c++) {
        light->ambient[c] *= by;
        light->diffuse[c] *= by;
        light->specular[c] *= by;
    }
}

void half_lights_make_a_whole_one(void **state)
{
    (void)state;
    struct setting all, whole, halves;
    setting_make(&all);
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        struct sb_light light = all.light[2 * type];
        setting_init(&whole);
        setting_one(&whole, (enum sb_light_type)type, light);
        scale_colours(&light, 0.5f);
        setting_init(&halves);
        setting_add(&halves, (enum sb_light_type)type, light);
        setting_add(&halves, (enum sb_light_type)type, light);
        for (int i = 0; i < WORDS; i++)
            check_same(&whole, words[i], &halves, words[i], 1, 1e-6);
    }
}

static void draw_one(const struct setting *all, int number, const char *how,
                     struct sb_image *image)
{
    struct setting one = *all;
    setting_one(&one, (enum sb_light_type)(number / 2), all->light[number]);
    draw(&one, how, image);
}

void the_light_of_several_is_the_sum_of_each(void **state)
{
    (void)state;
    struct setting all;
    setting_make(&all);
    for (int w = 0; w < WORDS; w++) {
        double sum[SIDE * SIDE * 4] = {0};
        struct sb_image image;
        for (int i = 0; i < 8; i++) {
            double most = 0;
            draw_one(&all, i, words[w], &image);
            for (int k = 0; k < SIDE * SIDE * 4; k++) {
                sum[k] += image.data[k];
                most = fmax(most, k % 4 == 3 ? 0 : image.data[k]);
            }
            assert_true(most > 0.01);
            sb_image_free(&image);
        }
        draw(&all, words[w], &image);
        for (int k = 0; k < SIDE * SIDE * 4; k++)
            if (k % 4 != 3)
                check_close(image.data[k], sum[k], 5e-6);
        sb_image_free(&image);
    }
}

// The world 2^n times as large, and every law of distance with it.
static struct setting enlarged(const struct setting *setting, int n)
{
    struct setting large = *setting;
    large.size = ldexp(1, n);
    struct sb_vec3 eye = {large.eye[0] * large.size, large.eye[1] * large.size,
                          large.eye[2] * large.size};
    for (int i = 12; i < 15; i++)
        large.view.m[i] *= large.size;
    large.eye[0] = eye.x;
    large.eye[1] = eye.y;
    large.eye[2] = eye.z;
    for (int i = 0; i < 8; i++) {
        struct sb_light *light = &large.light[i];
        for (int c = 0; c < 3; c++) {
            light->position[c] = ldexpf(light->position[c], n);
            light->extent[c] = ldexpf(light->extent[c], n);
            if (i / 2 == SB_LIGHT_AREA)
                light->direction[c] = ldexpf(light->direction[c], n);
        }
        light->range = ldexpf(light->range, n);
        light->radius = ldexpf(light->radius, n);
        light->linear = ldexpf(light->linear, -n);
        light->quadratic = ldexpf(light->quadratic, -2 * n);
    }
    return large;
}

void powers_of_two_scale_pictures_exactly(void **state)
{
    (void)state;
    static const int powers[] = {-10, -3, 4, 10};
    static const char *const laws[] = {"polynomial", "radius"};
    struct setting one;
    setting_make(&one);
    for (int l = 0; l < 2; l++)
        for (int w = 0; ways[w]; w++)
            for (int p = 0; p < 4; p++) {
                char how[160];
                const struct setting large = enlarged(&one, powers[p]);
                struct setting bright = one;
                snprintf(how, sizeof how,
                         "ambient=per_light area_shape=capsule attenuation=%s %s",
                         laws[l], ways[w]);
                check_same(&one, how, &large, how, 1, 1e-6);
                for (int i = 0; i < 8; i++)
                    scale_colours(&bright.light[i], ldexpf(1, powers[p]));
                check_same(&one, how, &bright, how, ldexp(1, -powers[p]), 1e-7);
            }
}

// The text of `sun` moves it by 1.1 degrees a frame: in phase p the light comes from where a
// light that is turned so far comes from.
void later_phases_show_lights_that_moved(void **state)
{
    (void)state;
    static const char how[] = "update=lights ambient=none", still[] = "ambient=none";
    struct setting sun, lamp;
    setting_init(&sun);
    setting_init(&lamp);
    struct sb_light light = light_at(0, 0, 0);
    light.direction[0] = 0.5f;
    light.direction[1] = -0.75f;
    setting_one(&sun, SB_LIGHT_DIR, light);
    setting_one(&lamp, SB_LIGHT_POINT, light_at(0.5, -0.25, 0.75));
    for (int phase = 0; phase < SB_PHASES; phase++) {
        struct setting *const settings[] = {&sun, &lamp};
        for (int s = 0; s < 2; s++) {
            struct setting moved = *settings[s];
            const double turn = phase * 1.1 * SB_PI / 180, x = light.direction[0],
                         y = light.direction[1];
            const double around = 2 * SB_PI * phase / SB_PHASES;
            moved.light[0].direction[0] = (float)(x * cos(turn) + y * sin(turn));
            moved.light[0].direction[1] = (float)(y * cos(turn) - x * sin(turn));
            moved.light[0].position[0] += (float)(0.05 * (cos(around) - 1));
            moved.light[0].position[2] += (float)(0.05 * sin(around));
            struct sb_image got, want, first;
            struct sb_image_difference by;
            draw_phase(settings[s], how, phase, &got);
            draw(&moved, still, &want);
            draw(settings[s], how, &first); // as pictures show it
            sb_image_compare(&got, &want, &by);
            assert_true(by.max <= 2e-6);
            sb_image_compare(&got, &first, &by);
            assert_true(phase == 0 ? by.max == 0 : by.max > 1e-3);
            sb_image_free(&got);
            sb_image_free(&want);
            sb_image_free(&first);
        }
    }
}

static void check_shortened(const char *how, bool stale)
{
    struct setting four, one;
    struct sb_image got, want;
    struct sb_image_difference by;
    setting_init(&four);
    for (int i = 0; i < 4; i++)
        setting_add(&four, SB_LIGHT_POINT, light_at(0.5 * i - 1, 0.25, 0.5));
    one = four;
    if (!stale)
        one.count[SB_LIGHT_POINT] = 1;
    draw_shortened(&four, how, 1, &got);
    draw(&one, how, &want);
    sb_image_compare(&got, &want, &by);
    if (by.max > 2e-6)
        fail_msg("%s: differs by %g", how, by.max);
    sb_image_free(&got);
    sb_image_free(&want);
}

// The setter of the LWJGL book leaves the entries behind a list as they were.
void a_list_that_gets_shorter_leaves_nothing_behind_but_by_the_slip(void **state)
{
    (void)state;
    static const char *const storages[] = {"uniform", "arrays", "ubo_std140",
                                           "ubo_shared"};
    for (int i = 0; i < 4; i++) {
        char how[200];
        snprintf(how, sizeof how, "loop=padded capacity=5 storage=%s", storages[i]);
        check_shortened(how, false);
        snprintf(how, sizeof how, "loop=dynamic capacity=5 storage=%s", storages[i]);
        check_shortened(how, false);
        snprintf(
            how, sizeof how,
            "loop=padded capacity=5 storage=%s space=view source=lwjgl text=as_written",
            storages[i]);
        check_shortened(how, true);
        snprintf(how, sizeof how,
                 "loop=padded capacity=5 storage=%s source=lwjgl text=corrected",
                 storages[i]);
        check_shortened(how, false);
    }
}

// The text of `ubo` has one struct for all types of light, and point lights only: the axis of a
// cone is uploaded for each, and not read.
void the_struct_for_all_types_carries_spot_members_that_nobody_reads(void **state)
{
    (void)state;
    static const char *const layouts[] = {"std140", "shared"};
    struct setting setting;
    setting_init(&setting);
    setting_add(&setting, SB_LIGHT_POINT, light_at(0, 0, 1));
    setting_add(&setting, SB_LIGHT_POINT, light_at(1, 0, 1));
    for (int i = 0; i < 2; i++) {
        char split[100], unified[160];
        int small, large, offset;
        snprintf(split, sizeof split, "ambient=per_light storage=ubo_%s", layouts[i]);
        snprintf(unified, sizeof unified, "%s layout=unified", split);
        reflect_block(&setting, split, "u_point[1].direction", &small, &offset);
        assert_int_equal(offset, -1);
        reflect_block(&setting, unified, "u_light[1].direction", &large, &offset);
        assert_in_range(offset, large / 2, large - 12);
        // Axis and cosine, at the least, of each of two.
        assert_true(large >= small + 2 * 16);
        check_same(&setting, split, &setting, unified, 1, 1e-6);
    }
}
