// What shadow maps hold, against the closed form of a room.
#include "shadow_world.h"

enum { SIZE = 32 };

// How far a texel may be off: the format, and the rasteriser, which interpolates positions to
// about 2^-20 of the size of the room.
static const struct {
    const char *word;
    int store;
    double tolerance;
} stores[] = {
    {"r8", SB_SHADOW_STORE_R8, 0.51 / 255},
    {"r16f", SB_SHADOW_STORE_R16F, 0x1p-11},
    {"r32f", SB_SHADOW_STORE_R32F, 5e-6},
    {"depth", SB_SHADOW_STORE_DEPTH, 1e-6},
};
enum { STORES = sizeof stores / sizeof *stores };

// A texel across the outline of the block sees either; there only the two sides are checked.
static bool on_an_outline(int caster, const double *direction)
{
    bool in = false, out = false;
    for (int i = 0; i < 27; i++) {
        double near[3];
        const int step[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        for (int j = 0; j < 3; j++)
            near[j] = direction[j] + 0.02 * step[j] / SIZE;
        const bool hit = isfinite(distance_in(&block, lights[caster], near));
        in |= hit;
        out |= !hit;
    }
    return in && out;
}

// Reads a face as the texture has it, without any table of the program.
static void read_face(const struct sb_shadow *shadow, int caster, int face, float *texel)
{
    GLuint framebuffer;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (shadow->kind == SB_SHADOW_MAP_SIX2D)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                               shadow->texture[6 * caster + face], 0);
    else if (shadow->kind == SB_SHADOW_MAP_CUBE)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                               GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)face,
                               shadow->texture[caster], 0);
    else
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                  shadow->texture[0], 0, 6 * caster + face);
    glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_FLOAT, texel);
    glDeleteFramebuffers(1, &framebuffer);
}

static void check_face(const struct sb_shadow *shadow, int caster, int face)
{
    static float texel[SIZE * SIZE * 4];
    read_face(shadow, caster, face, texel);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double d[3];
            direction_of(shadow->kind, face, (2 * x + 1.0) / SIZE - 1,
                         (2 * y + 1.0) / SIZE - 1, d);
            if (!on_an_outline(caster, d))
                check_close(texel[4 * (y * SIZE + x)],
                            stored_seen(caster, d, SB_SHADOW_STORE_R32F), 5e-6);
        }
}

static void every_texel_of_every_face_holds_the_distance_that_its_direction_sees(
    void **state)
{
    (void)state;
    for (int i = 0; ways[i]; i++) {
        char words[100];
        snprintf(words, sizeof words, "%s shadow_size=%d", ways[i], SIZE);
        if (!can(words))
            continue;
        struct fixture fixture;
        fixture_make(&fixture, words);
        for (int caster = 0; caster < CASTERS; caster++)
            for (int face = 0; face < 6; face++)
                check_face(&fixture.shadow, caster, face);
        fixture_free(&fixture);
    }
}

// The cross, as docs/glsl.md draws it: the direction of a pixel, or false in its corners.
static bool direction_in_cross(int x, int y, double *d)
{
    const int column = x / SIZE, row = y / SIZE;
    const double u = (2 * (x % SIZE) + 1.0) / SIZE - 1;
    const double v = (2 * (y % SIZE) + 1.0) / SIZE - 1;
    const double middle[4][3] = {{-1, v, -u}, {u, v, -1}, {1, v, u}, {-u, v, 1}};
    const double above[3] = {u, 1, v}, below[3] = {u, -1, -v};
    if (row != 1 && column != 1)
        return false;
    memcpy(d, row == 2 ? above : row == 0 ? below : middle[column], 3 * sizeof *d);
    return true;
}

static double check_cross(const struct fixture *fixture, int caster, int store)
{
    struct sb_image image;
    struct sb_error err = {0};
    double least = 1;
    if (!sb_shadow_read(&fixture->shadow, &caps, caster, &image, &err))
        fail_msg("%s", err.text);
    assert_int_equal(image.width, 4 * SIZE);
    assert_int_equal(image.height, 3 * SIZE);
    assert_int_equal(image.channels, 1);
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++) {
            double d[3], want = 0;
            const bool inside = direction_in_cross(x, y, d);
            if (inside && on_an_outline(caster, d))
                continue;
            if (inside)
                want = stored_seen(caster, d, stores[store].store);
            check_close(*sb_image_at(&image, x, y), want, stores[store].tolerance);
            least = fmin(least, *sb_image_at(&image, x, y));
        }
    sb_image_free(&image);
    return least;
}

static void the_unfolded_cross_shows_every_store_of_every_kind(void **state)
{
    (void)state;
    for (int i = 0; ways[i]; i++)
        for (int s = 0; s < STORES; s++) {
            char words[100];
            snprintf(words, sizeof words, "%s shadow_size=%d shadow_store=%s", ways[i],
                     SIZE, stores[s].word);
            if (!can(words))
                continue;
            struct fixture fixture;
            fixture_make(&fixture, words);
            for (int caster = 0; caster < CASTERS; caster++) {
                const double least = check_cross(&fixture, caster, s);
                if (stores[s].store != SB_SHADOW_STORE_DEPTH)
                    check_close(least, 0, 0);
            }
            fixture_free(&fixture);
        }
}

static void what_is_beyond_the_range_is_not_drawn(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_image image;
    struct sb_error err = {0};
    char words[100];
    snprintf(words, sizeof words, "shadow_store=r8 shadow_size=%d", SIZE);
    fixture_make(&fixture, words);
    struct sb_light light[CASTERS];
    memcpy(light, fixture.world.light, sizeof light);
    light[0].range = 0.25f; // no wall is so near
    const struct sb_lights near = {light, {0, CASTERS, 0, 0}};
    sb_shadow_draw(&fixture.shadow, &near);
    assert_true(sb_shadow_read(&fixture.shadow, &caps, 0, &image, &err));
    for (int i = 0; i < image.width * image.height; i++)
        check_close(image.data[i], 0, 0);
    sb_image_free(&image);
    fixture_free(&fixture);
}

static void a_map_drawn_again_follows_its_light(void **state)
{
    (void)state;
    struct fixture fixture;
    char words[100];
    snprintf(words, sizeof words, "shadow_store=r8 shadow_size=%d", SIZE);
    fixture_make(&fixture, words);
    // Each light where the other was: each map as the other's.
    struct sb_light light[CASTERS] = {fixture.world.light[1], fixture.world.light[0]};
    struct sb_image before[CASTERS], after[CASTERS];
    const struct sb_lights changed = {light, {0, CASTERS, 0, 0}};
    struct sb_image_difference difference;
    for (int i = 0; i < CASTERS; i++)
        assert_true(sb_shadow_read(&fixture.shadow, &caps, i, &before[i], NULL));
    sb_shadow_draw(&fixture.shadow, &changed);
    for (int i = 0; i < CASTERS; i++)
        assert_true(sb_shadow_read(&fixture.shadow, &caps, i, &after[i], NULL));
    for (int i = 0; i < CASTERS; i++) {
        sb_image_compare(&before[i], &after[1 - i], &difference);
        assert_int_equal(difference.pixels, 0);
    }
    sb_image_compare(&before[0], &before[1], &difference);
    assert_true(difference.pixels > 0);
    for (int i = 0; i < CASTERS; i++) {
        sb_image_free(&before[i]);
        sb_image_free(&after[i]);
    }
    fixture_free(&fixture);
}

// After a frame of this phase, or after drawing its maps alone.
static void map_of_phase(const struct fixture *fixture, int phase, bool in_frame,
                         struct sb_image *map)
{
    const struct sb_shadow *shadow = &fixture->shadow;
    const struct sb_target_params size = {SIZE, SIZE, 1, SB_GL_R32UI};
    struct sb_error err = {0};
    struct sb_gl_program program;
    struct sb_binding binding;
    struct sb_target target;
    assert_true(sb_id_program_make(&program, caps.gles, &err));
    const struct sb_binding_params params = {
        .program = program.name,
        .upload = &fixture->upload,
        .variant = &fixture->variant,
    };
    assert_true(sb_binding_make(&binding, &params, &err));
    assert_true(sb_target_make(&target, &caps, &size, &err));
    if (in_frame)
        sb_frame_draw(&(struct sb_frame_params){
            .binding = &binding,
            .shadow = shadow,
            .target = &target,
            .layers = 1,
            .phase = phase,
            .gles = caps.gles,
        });
    else
        sb_shadow_draw(shadow, &shadow->phase[phase]);
    assert_true(sb_shadow_read(shadow, &caps, 1, map, &err));
    sb_target_free(&target);
    sb_binding_free(&binding);
    sb_gl_program_free(&program);
}

static void a_frame_draws_the_maps_of_its_phase_where_casters_move(void **state)
{
    (void)state;
    static const char *const updates[] = {"lights", "lights+shadows"};
    for (int moves = 0; moves < 2; moves++) {
        struct fixture fixture;
        struct sb_image before, after, want;
        struct sb_image_difference difference;
        char words[100];
        snprintf(words, sizeof words, "update=%s shadow_store=r8 shadow_size=%d",
                 updates[moves], SIZE);
        fixture_make(&fixture, words);
        assert_int_equal(fixture.shadow.phase_count, moves ? SB_PHASES : 1);
        map_of_phase(&fixture, 0, true, &before);
        map_of_phase(&fixture, 3, true, &after);
        map_of_phase(&fixture, moves ? 3 : 0, false, &want);
        sb_image_compare(&after, &want, &difference);
        assert_int_equal(difference.pixels, 0);
        sb_image_compare(&after, &before, &difference);
        assert_int_equal(difference.pixels > 0, moves);
        sb_image_free(&before);
        sb_image_free(&after);
        sb_image_free(&want);
        fixture_free(&fixture);
    }
}

static void only_casters_have_a_map_to_read(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_image image;
    struct sb_error err = {0};
    fixture_make(&fixture, "shadow_store=r8 shadow_size=16");
    assert_false(sb_shadow_read(&fixture.shadow, &caps, CASTERS, &image, &err));
    check_contains(err.text, "the first 2 point lights cast shadows");
    fixture_free(&fixture);
}

static void a_caster_without_a_range_is_refused(void **state)
{
    (void)state;
    struct world world;
    struct sb_upload upload;
    struct sb_shadow shadow = {0};
    struct sb_variant variant;
    struct sb_error err = {0};
    world_make(&world);
    world.light[1].range = 0;
    shadow_variant("shadow_store=r8", &variant);
    sb_upload_make(&upload, &world.scene);
    const struct sb_shadow_params params = {
        .upload = &upload, .variant = &variant, .caps = &caps};
    assert_false(sb_shadow_make(&shadow, &params, &err));
    check_contains(err.text, "point light 1 casts shadows: range 0");
    sb_shadow_free(&shadow);
    sb_upload_free(&upload);
}

int main(void)
{
    struct gl_test test;
    gl_test_open(&test);
    caps = test.caps;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            every_texel_of_every_face_holds_the_distance_that_its_direction_sees),
        cmocka_unit_test(the_unfolded_cross_shows_every_store_of_every_kind),
        cmocka_unit_test(what_is_beyond_the_range_is_not_drawn),
        cmocka_unit_test(a_map_drawn_again_follows_its_light),
        cmocka_unit_test(a_frame_draws_the_maps_of_its_phase_where_casters_move),
        cmocka_unit_test(only_casters_have_a_map_to_read),
        cmocka_unit_test(a_caster_without_a_range_is_refused),
    };
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
