// Lights in the space of the lighting, under a camera that is turned and far from the origin.
#include "test.h"

#include "math/mat.h"
#include "scene/scene.h"

static const struct sb_vec3 eye = {3, -2, 5}, target = {-1, 4, -7}, up = {0, 1, 0};

static struct sb_camera camera(void)
{
    struct sb_camera made = {0};
    const struct sb_mat4 view = sb_mat4_look_at(eye, target, up);
    for (int i = 0; i < 16; i++)
        made.view[i] = (float)view.m[i];
    return made;
}

// Right, up and back of the camera: what a vector has along them is what it is in view space.
static void check_seen(const float seen[3], struct sb_vec3 vector)
{
    const struct sb_vec3 back = sb_vec3_normalise(sb_vec3_sub(eye, target));
    const struct sb_vec3 right = sb_vec3_normalise(sb_vec3_cross(up, back));
    check_close(seen[0], sb_vec3_dot(vector, right), 2e-6);
    check_close(seen[1], sb_vec3_dot(vector, sb_vec3_cross(back, right)), 2e-6);
    check_close(seen[2], sb_vec3_dot(vector, back), 2e-6);
}

static struct sb_vec3 vec(const float v[3])
{
    return (struct sb_vec3){v[0], v[1], v[2]};
}

static const struct sb_light light = {
    .position = {0.25f, -3, 8},
    .direction = {0.5f, -2, 1.5f},
    .range = 9,
    .intensity = 1,
    .ambient = {1, 2, 3},
    .diffuse = {4, 5, 6},
    .specular = {7, 8, 9},
    .cos_cutoff = 0.5f,
    .cutoff = 1,
    .radius = 2,
    .extent = {1, 2, 3},
};

static void positions_are_seen_from_the_eye_and_directions_are_only_turned(void **state)
{
    (void)state;
    const struct sb_camera from = camera();
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        struct sb_light seen = sb_light_to_view(&light, t, &from, false);
        if (t != SB_LIGHT_DIR)
            check_seen(seen.position, sb_vec3_sub(vec(light.position), eye));
        check_seen(seen.direction, vec(light.direction));
        memcpy(seen.position, light.position, sizeof seen.position);
        memcpy(seen.direction, light.direction, sizeof seen.direction);
        assert_memory_equal(&seen, &light, sizeof seen); // nothing else has changed
    }
}

static void a_sun_that_is_kept_stays_in_world_space_and_spots_do_not(void **state)
{
    (void)state;
    const struct sb_camera from = camera();
    const struct sb_light sun = sb_light_to_view(&light, SB_LIGHT_DIR, &from, true);
    assert_memory_equal(sun.direction, light.direction, sizeof sun.direction);
    const struct sb_light spot = sb_light_to_view(&light, SB_LIGHT_SPOT, &from, true);
    check_seen(spot.direction, vec(light.direction));
}

// Far from the origin, float arithmetic would lose what the difference to the eye leaves.
static void a_position_is_transformed_in_double(void **state)
{
    (void)state;
    struct sb_camera from = {0};
    const struct sb_mat4 view = sb_mat4_rotation(0.7, (struct sb_vec3){1, 2, 3});
    struct sb_light far = {.position = {1e6f, 1e6f, 1e6f}};
    for (int i = 0; i < 16; i++)
        from.view[i] = (float)view.m[i];
    for (int row = 0; row < 3; row++) { // the eye is where the light is
        long double shift = 0;
        for (int k = 0; k < 3; k++)
            shift -= (long double)from.view[4 * k + row] * far.position[k];
        from.view[12 + row] = (float)shift;
    }
    const struct sb_light seen = sb_light_to_view(&far, SB_LIGHT_POINT, &from, false);
    for (int row = 0; row < 3; row++) {
        long double sum = from.view[12 + row];
        for (int k = 0; k < 3; k++)
            sum += (long double)from.view[4 * k + row] * far.position[k];
        check_close(seen.position[row], (double)sum, 1e-6);
    }
}

static struct sb_light as_lit(enum sb_light_type type, int space, int layout, int source,
                              int text)
{
    const struct sb_camera from = camera();
    struct sb_variant variant = {0};
    variant.value[SB_AXIS_SPACE] = space;
    variant.value[SB_AXIS_LAYOUT] = layout;
    variant.value[SB_AXIS_SOURCE] = source;
    variant.value[SB_AXIS_TEXT] = text;
    return sb_light_as_lit(&light, type, &variant, &from);
}

static bool same(struct sb_light a, struct sb_light b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void a_variant_lights_in_its_own_space_and_layout(void **state)
{
    (void)state;
    enum { WORLD = SB_SPACE_WORLD, VIEW = SB_SPACE_VIEW, SPLIT = SB_LAYOUT_SPLIT };
    const struct sb_camera from = camera();
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const struct sb_light view = sb_light_to_view(&light, t, &from, false);
        const struct sb_light kept = sb_light_to_view(&light, t, &from, true);
        assert_true(
            same(as_lit(t, WORLD, SPLIT, SB_SOURCE_LWJGL, SB_TEXT_AS_WRITTEN), light));
        assert_true(
            same(as_lit(t, VIEW, SPLIT, SB_SOURCE_NONE, SB_TEXT_CORRECTED), view));
        assert_true(
            same(as_lit(t, VIEW, SPLIT, SB_SOURCE_LWJGL, SB_TEXT_CORRECTED), view));
        assert_true(
            same(as_lit(t, VIEW, SPLIT, SB_SOURCE_UBO, SB_TEXT_AS_WRITTEN), view));
        assert_true(
            same(as_lit(t, VIEW, SPLIT, SB_SOURCE_LWJGL, SB_TEXT_AS_WRITTEN), kept));
        assert_true(same(as_lit(t, VIEW, SB_LAYOUT_UNIFIED, SB_SOURCE_NONE, 0),
                         sb_light_unified(&view, t)));
    }
}

static struct sb_variant counted(int dir, int point, int sun, int loop, int capacity)
{
    struct sb_variant variant = {0};
    variant.value[SB_AXIS_DIR] = dir;
    variant.value[SB_AXIS_POINT] = point;
    variant.value[SB_AXIS_SUN] = sun;
    variant.value[SB_AXIS_LOOP] = loop;
    variant.value[SB_AXIS_CAPACITY] = capacity;
    return variant;
}

static void arrays_have_the_slots_that_their_loop_wants(void **state)
{
    (void)state;
    static const struct {
        int sun, loop, capacity, dir, point, spot;
    } rows[] = {
        {-91, SB_LOOP_CONSTANT, 0, 2, 3, 0}, {100, SB_LOOP_UNROLLED, 0, 1, 3, 0},
        {100, SB_LOOP_PADDED, 0, 2, 3, 0},   {90, SB_LOOP_DYNAMIC, 5, 2, 5, 0},
        {-91, SB_LOOP_DYNAMIC, 2, 2, 3, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct sb_variant v =
            counted(2, 3, rows[i].sun, rows[i].loop, rows[i].capacity);
        assert_int_equal(sb_lights_slots(&v, SB_LIGHT_DIR), rows[i].dir);
        assert_int_equal(sb_lights_slots(&v, SB_LIGHT_POINT), rows[i].point);
        assert_int_equal(sb_lights_slots(&v, SB_LIGHT_SPOT), rows[i].spot);
        assert_int_equal(sb_lights_slots(&v, SB_LIGHT_AREA), rows[i].spot);
    }
    struct sb_variant unified = counted(0, 0, -91, SB_LOOP_PADDED, 5);
    unified.value[SB_AXIS_LAYOUT] = SB_LAYOUT_UNIFIED;
    // The one array has room for five in all, whatever their types.
    assert_int_equal(sb_lights_slots(&unified, SB_LIGHT_SPOT), 0);
    assert_int_equal(sb_lights_unified_slots(&unified), 5);
    unified.value[SB_AXIS_POINT] = 4;
    unified.value[SB_AXIS_SPOT] = 3;
    assert_int_equal(sb_lights_unified_slots(&unified), 7);
    unified.value[SB_AXIS_LAYOUT] = SB_LAYOUT_SPLIT;
    assert_int_equal(sb_lights_unified_slots(&unified), 5 + 5); // no area light, no room
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_are_seen_from_the_eye_and_directions_are_only_turned),
        cmocka_unit_test(a_sun_that_is_kept_stays_in_world_space_and_spots_do_not),
        cmocka_unit_test(a_position_is_transformed_in_double),
        cmocka_unit_test(a_variant_lights_in_its_own_space_and_layout),
        cmocka_unit_test(arrays_have_the_slots_that_their_loop_wants),
    };
    return run_tests(tests);
}
