// space=eye: the floats of a scene are relative to the eye, and no offset is left in them.
#include "scene.h"

// What a float near the origin loses; at an offset of 1e9 a double has lost 2^-24.
#define CLOSE 4e-6

static void check_moved_by(const float got[3], const float wanted[3], const float by[3])
{
    for (int c = 0; c < 3; c++)
        check_close(got[c] + (double)by[c], wanted[c], CLOSE);
}

// `near` is space=eye, `world` the same scene around its own origin.
static void check_relative(const struct sb_scene *near, const struct sb_scene *world)
{
    static const float origin[3] = {0};
    const float *eye = world->camera.eye;
    check_moved_by(near->camera.eye, origin, origin);
    for (int i = 0; i < 16; i++)
        check_close(near->camera.view[i], i >= 12 && i < 15 ? 0 : world->camera.view[i],
                    0);
    assert_memory_equal(near->camera.projection, world->camera.projection,
                        sizeof world->camera.projection);
    for (int d = 0; d < world->draw_count; d++) {
        const struct sb_draw *a = &near->draw[d], *b = &world->draw[d];
        check_moved_by(a->model + 12, b->model + 12, eye);
        assert_memory_equal(a->model, b->model, 12 * sizeof *a->model);
        assert_memory_equal(a->normal_matrix, b->normal_matrix, sizeof a->normal_matrix);
    }
    struct sb_light moved[2][64];
    const struct sb_phase phase = {.number = 3, .scale = 1};
    sb_lights_phase(&near->lights, &phase, moved[0]);
    sb_lights_phase(&world->lights, &phase, moved[1]);
    for (int i = 0; i < sb_lights_total(&world->lights); i++) {
        struct sb_light a = near->lights.light[i];
        const struct sb_light b = world->lights.light[i];
        const float *by = b.w == 0 ? origin : eye;
        check_moved_by(a.position, b.position, by);
        check_moved_by(moved[0][i].position, moved[1][i].position, by);
        memcpy(a.position, b.position, sizeof a.position);
        assert_memory_equal(&a, &b, sizeof a); // nothing else depends on the origin
    }
}

static void with_the_origin_at_the_eye_no_offset_is_left_in_the_floats(void **state)
{
    (void)state;
    static const double offsets[] = {0, 1e6, 1e9};
    struct sb_variant variant = scene_variant(2, 6, 4);
    variant.value[SB_AXIS_AREA] = 3;
    variant.value[SB_AXIS_LAMPS] = SB_LAMPS_ON;
    for (int i = 0; i < sb_scene_row_count; i++) {
        variant.value[SB_AXIS_SPACE] = SB_SPACE_WORLD;
        variant.value[SB_AXIS_OFFSET] = 0;
        struct sb_scene world = made(sb_scene_rows[i].name, &variant);
        variant.value[SB_AXIS_SPACE] = SB_SPACE_EYE;
        for (size_t k = 0; k < sizeof offsets / sizeof *offsets; k++) {
            variant.value[SB_AXIS_OFFSET] = offsets[k];
            struct sb_scene near = made(sb_scene_rows[i].name, &variant);
            check_relative(&near, &world);
            sb_scene_free(&near);
        }
        sb_scene_free(&world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(with_the_origin_at_the_eye_no_offset_is_left_in_the_floats),
    };
    return run_tests(tests);
}
