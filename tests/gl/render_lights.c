// Lights arrive where the shader reads them, whatever they are kept in: each member is written
// to a pixel of its own and compared with the C struct.
#include "render_world.h"

static const struct light_text all = {{DIR, POINT, SPOT, AREA, 0}, AS_UNIFORMS};

static void every_member_of_every_light_arrives_in_every_storage(void **state)
{
    (void)state;
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        struct light_text lights = all;
        struct fixture fixture;
        const struct sb_light *want[SB_LIGHT_STRUCT_COUNT];
        lights.storage = storage;
        fixture_init(&fixture);
        fixture_make_members(&fixture, &lights);
        want_lists(want, &fixture.world.scene.lights);
        assert_int_equal(fixture.binding.lights.buffer != 0, storage >= AS_STD140);
        check_members(&fixture, &lights, want);
        fixture_free(&fixture);
    }
}

static void a_program_with_fewer_lights_gets_the_first_of_each_type(void **state)
{
    (void)state;
    static const int fewer[][SB_LIGHT_STRUCT_COUNT] = {
        {1, 2, 1, 1}, {0, 3, 0, 0}, {0, 0, 2, 0}, {2, 0, 1, 2}};
    for (size_t i = 0; i < sizeof fewer / sizeof *fewer; i++) {
        for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
            struct light_text lights = {.storage = storage};
            struct fixture fixture;
            const struct sb_light *want[SB_LIGHT_STRUCT_COUNT];
            memcpy(lights.count, fewer[i], sizeof lights.count);
            fixture_init(&fixture);
            fixture_make_members(&fixture, &lights);
            want_lists(want, &fixture.world.scene.lights);
            check_members(&fixture, &lights, want);
            fixture_free(&fixture);
        }
    }
}

static void lights_that_are_off_are_black_and_come_back(void **state)
{
    (void)state;
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        struct light_text lights = all;
        struct fixture fixture;
        struct sb_light off[LIGHTS];
        const struct sb_light *want[SB_LIGHT_STRUCT_COUNT];
        lights.storage = storage;
        fixture_init(&fixture);
        fixture_make_members(&fixture, &lights);
        const struct sb_lights of_test = {off, {DIR, POINT, SPOT, AREA}};
        want_lists(want, &of_test);
        for (int first = 0; first < LIGHTS; first++) {
            memcpy(off, fixture.world.light, sizeof off);
            for (int i = first; i < LIGHTS && i < first + 3; i++) {
                memset(off[i].ambient, 0, sizeof off[i].ambient);
                memset(off[i].diffuse, 0, sizeof off[i].diffuse);
                memset(off[i].specular, 0, sizeof off[i].specular);
            }
            sb_binding_lights(&fixture.binding, first, 3);
            check_members(&fixture, &lights, want);
        }
        memcpy(off, fixture.world.light, sizeof off);
        sb_binding_lights(&fixture.binding, 0, 0);
        check_members(&fixture, &lights, want);
        fixture_free(&fixture);
    }
}

static void unified_lights_arrive_in_the_order_of_the_whole_list(void **state)
{
    (void)state;
    enum { MEANT = DIR + POINT + SPOT }; // the unified struct has no area lights
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        const struct light_text lights = {{[SB_LIGHT_UNIFIED] = MEANT}, storage};
        const struct sb_light *want[SB_LIGHT_STRUCT_COUNT] = {0};
        struct fixture fixture;
        struct sb_light unified[MEANT];
        fixture_init(&fixture);
        fixture.variant.value[SB_AXIS_LAYOUT] = SB_LAYOUT_UNIFIED;
        fixture.world.scene.lights.count[SB_LIGHT_AREA] = 0;
        fixture_make_members(&fixture, &lights);
        for (int i = 0; i < MEANT; i++) {
            const enum sb_light_type type = i < DIR           ? SB_LIGHT_DIR
                                            : i < DIR + POINT ? SB_LIGHT_POINT
                                                              : SB_LIGHT_SPOT;
            unified[i] = sb_light_unified(&fixture.world.light[i], type);
            check_close(unified[i].w, type != SB_LIGHT_DIR, 0);
        }
        want[SB_LIGHT_UNIFIED] = unified;
        check_members(&fixture, &lights, want);
        fixture_free(&fixture);
    }
}

// Axes: x' = 1 - z, y' = y + 2, z' = x + 3.
static const float quarter_turn[16] = {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 2, 3, 1};

static void turn(struct sb_light *light, bool place, bool direction)
{
    const float p[3] = {light->position[0], light->position[1], light->position[2]};
    const float d[3] = {light->direction[0], light->direction[1], light->direction[2]};
    const float p_view[3] = {1 - p[2], p[1] + 2, p[0] + 3};
    const float d_view[3] = {-d[2], d[1], d[0]};
    if (place)
        memcpy(light->position, p_view, sizeof p_view);
    if (direction)
        memcpy(light->direction, d_view, sizeof d_view);
}

static void lights_of_view_space_are_where_the_camera_sees_them(void **state)
{
    (void)state;
    for (int as_written = 0; as_written < 2; as_written++) {
        struct fixture fixture;
        struct sb_light seen[LIGHTS];
        const struct sb_light *want[SB_LIGHT_STRUCT_COUNT];
        fixture_init(&fixture);
        memcpy(fixture.world.scene.camera.view, quarter_turn, sizeof quarter_turn);
        fixture.variant.value[SB_AXIS_SPACE] = SB_SPACE_VIEW;
        if (as_written) {
            fixture.variant.value[SB_AXIS_SOURCE] = SB_SOURCE_LWJGL;
            fixture.variant.value[SB_AXIS_TEXT] = SB_TEXT_AS_WRITTEN;
        }
        fixture_make_members(&fixture, &all);
        memcpy(seen, fixture.world.light, sizeof seen);
        for (int i = 0; i < LIGHTS; i++) // the text forgets the sun
            turn(&seen[i], i >= DIR, i >= DIR || !as_written);
        const struct sb_lights of_test = {seen, {DIR, POINT, SPOT, AREA}};
        want_lists(want, &of_test);
        check_members(&fixture, &all, want);
        fixture_free(&fixture);
    }
}

static void view_space_is_computed_in_double(void **state)
{
    (void)state;
    // 0.6f is 0.60000002384185791015625; in floats the difference would be 0 or 4.
    static const float far_away[16] = {0.6f, -0.8f, 0, 0, 0.8f,  0.6f, 0, 0,
                                       0,    0,     1, 0, -6e7f, 8e7f, 0, 1};
    static const struct light_text one = {{[SB_LIGHT_POINT] = 1}, AS_UNIFORMS};
    const struct sb_light *want[SB_LIGHT_STRUCT_COUNT];
    struct fixture fixture;
    fixture_init(&fixture);
    memcpy(fixture.world.scene.camera.view, far_away, sizeof far_away);
    fixture.variant.value[SB_AXIS_SPACE] = SB_SPACE_VIEW;
    struct sb_light *light = &fixture.world.light[DIR];
    light->position[0] = 1e8f;
    light->position[1] = light->position[2] = 0;
    fixture_make_members(&fixture, &one);
    struct sb_light seen = *light;
    seen.position[0] = 2.384185791015625f;
    seen.position[1] = -1.1920928955078125f; // -0.800000011920928955078125
    want[SB_LIGHT_POINT] = &seen;
    check_members(&fixture, &one, want);
    fixture_free(&fixture);
}

// --- arrays larger than the list -------------------------------------------------------

enum { CAPACITY = POINT + 3 };

static void padded_init(struct fixture *fixture, bool as_written)
{
    fixture_init(fixture);
    fixture->variant.value[SB_AXIS_LOOP] = SB_LOOP_PADDED;
    fixture->variant.value[SB_AXIS_CAPACITY] = CAPACITY;
    fixture->variant.value[SB_AXIS_POINT] = POINT; // room is for types that there are
    if (as_written) {
        fixture->variant.value[SB_AXIS_SOURCE] = SB_SOURCE_LWJGL;
        fixture->variant.value[SB_AXIS_TEXT] = SB_TEXT_AS_WRITTEN;
    }
}

// A full array, then one light: what stands behind it is switched off, and otherwise left as
// it was; the text leaves it altogether.
static void entries_behind_a_shorter_list_are_off_but_stale_in_the_text(void **state)
{
    (void)state;
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        for (int as_written = 0; as_written < 2; as_written++) {
            const struct light_text lights = {{[SB_LIGHT_POINT] = CAPACITY}, storage};
            const struct sb_light *want[SB_LIGHT_STRUCT_COUNT] = {0};
            struct fixture fixture;
            struct sb_light points[CAPACITY], shown[CAPACITY];
            padded_init(&fixture, as_written);
            fixture_make_members(&fixture, &lights);
            // The scene's four lights are there, and entries that nobody has set are zero.
            memset(shown, 0, sizeof shown);
            memcpy(shown, &fixture.world.light[DIR], POINT * sizeof *shown);
            want[SB_LIGHT_POINT] = shown;
            check_members(&fixture, &lights, want);

            float next = 5000;
            number(points, sizeof points, &next);
            struct sb_lights list = {points, {[SB_LIGHT_POINT] = CAPACITY}};
            sb_light_upload_set(&fixture.binding.lights, &list);
            want[SB_LIGHT_POINT] = points;
            check_members(&fixture, &lights, want);

            list.count[SB_LIGHT_POINT] = 1;
            sb_light_upload_set(&fixture.binding.lights, &list);
            memcpy(shown, points, sizeof shown);
            for (int i = 1; !as_written && i < CAPACITY; i++)
                shown[i].intensity = 0;
            want[SB_LIGHT_POINT] = shown;
            check_members(&fixture, &lights, want);
            fixture_free(&fixture);
        }
    }
}

// The sun is not in the list at night, but its entry of a padded array is.
static void the_entry_of_a_sun_that_has_set_is_off(void **state)
{
    (void)state;
    static const struct light_text lights = {{[SB_LIGHT_DIR] = DIR}, AS_UNIFORMS};
    const struct sb_light *want[SB_LIGHT_STRUCT_COUNT] = {0};
    struct sb_light shown[DIR] = {0};
    struct fixture fixture;
    padded_init(&fixture, false);
    fixture.variant.value[SB_AXIS_DIR] = DIR;
    fixture.world.scene.lights =
        (struct sb_lights){fixture.world.light, {[SB_LIGHT_DIR] = DIR - 1}};
    fixture_make_members(&fixture, &lights);
    shown[0] = fixture.world.light[0];
    want[SB_LIGHT_DIR] = shown;
    check_members(&fixture, &lights, want);
    // … also when another list was there before.
    sb_light_upload_set(&fixture.binding.lights,
                        &(struct sb_lights){fixture.world.light, {[SB_LIGHT_DIR] = DIR}});
    sb_binding_lights(&fixture.binding, 0, 0);
    shown[1] = fixture.world.light[1];
    shown[1].intensity = 0;
    check_members(&fixture, &lights, want);
    fixture_free(&fixture);
}

static const char counts_fragment[] =
    "uniform int u_dir_count, u_point_count, u_spot_count, u_area_count, u_light_count;\n"
    "out vec4 o_color;\n"
    "void main()\n"
    "{\n"
    "    o_color = vec4(u_dir_count, u_point_count, u_spot_count, u_area_count);\n"
    "    if (int(gl_FragCoord.x) == 1) o_color = vec4(u_light_count);\n"
    "}\n";

static void check_counts(struct fixture *fixture, int dir, int point, int spot, int area)
{
    const int want[4] = {dir, point, spot, area};
    struct sb_image image;
    draw_frame(fixture, -1);
    read_target(fixture, &image);
    for (int c = 0; c < 4; c++)
        check_close(sb_image_at(&image, 0, 0)[c], want[c], 0);
    check_close(sb_image_at(&image, 1, 0)[0], dir + point + spot + area, 0);
    sb_image_free(&image);
}

static void counts_of_a_dynamic_loop_are_those_of_the_list(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_text vertex = {0}, fragment = {0};
    fixture_init(&fixture);
    fixture.variant.value[SB_AXIS_LOOP] = SB_LOOP_DYNAMIC;
    add_vertex_shader(&vertex, caps.gles);
    add_version(&fragment, caps.gles);
    sb_text_add(&fragment, counts_fragment);
    fixture_make(&fixture, vertex.data, fragment.data);
    check_counts(&fixture, DIR, POINT, SPOT, AREA);
    const struct sb_lights fewer = {fixture.world.light, {1, 3, 0, 2}};
    assert_int_equal(sb_light_upload_set(&fixture.binding.lights, &fewer), 5 + 1);
    check_counts(&fixture, 1, 3, 0, 2);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
    fixture_free(&fixture);
}

// --- calls -----------------------------------------------------------------------------

static int uniforms_seen, buffers_seen;
static PFNGLUNIFORM1FVPROC real_uniform1;
static PFNGLUNIFORM3FVPROC real_uniform3;
static PFNGLBUFFERSUBDATAPROC real_sub_data;

static void GLAD_API_PTR see_uniform1(GLint location, GLsizei count, const GLfloat *value)
{
    uniforms_seen++;
    real_uniform1(location, count, value);
}

static void GLAD_API_PTR see_uniform3(GLint location, GLsizei count, const GLfloat *value)
{
    uniforms_seen++;
    real_uniform3(location, count, value);
}

static void GLAD_API_PTR see_sub_data(GLenum target, GLintptr offset, GLsizeiptr size,
                                      const void *data)
{
    buffers_seen++;
    real_sub_data(target, offset, size, data);
}

// Calls of one upload, as it counts them itself; what reaches the driver is in …_seen.
static int64_t upload_seen(const struct fixture *fixture)
{
    real_uniform1 = glad_glUniform1fv;
    real_uniform3 = glad_glUniform3fv;
    real_sub_data = glad_glBufferSubData;
    glad_glUniform1fv = see_uniform1;
    glad_glUniform3fv = see_uniform3;
    glad_glBufferSubData = see_sub_data;
    uniforms_seen = buffers_seen = 0;
    const int64_t calls =
        sb_light_upload_set(&fixture->binding.lights, &fixture->world.scene.lights);
    glad_glUniform1fv = real_uniform1;
    glad_glUniform3fv = real_uniform3;
    glad_glBufferSubData = real_sub_data;
    return calls;
}

static void an_upload_counts_the_calls_that_reach_the_driver(void **state)
{
    (void)state;
    // A call a member of each light, an array, or a buffer; and the program is made current, or
    // the buffer bound.
    const int members = sb_light_structs[SB_LIGHT_POINT].field_count;
    const struct {
        int uniforms, buffers, calls;
    } want[LIGHT_STORAGES] = {
        [AS_UNIFORMS] = {POINT * members, 0, POINT * members + 1},
        [AS_ARRAYS] = {members, 0, members + 1},
        [AS_STD140] = {0, 1, 2},
        [AS_SHARED] = {0, 1, 2},
    };
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        const struct light_text lights = {{[SB_LIGHT_POINT] = POINT}, storage};
        struct fixture fixture;
        fixture_init(&fixture);
        fixture_make_members(&fixture, &lights);
        assert_int_equal(upload_seen(&fixture), want[storage].calls);
        assert_int_equal(uniforms_seen, want[storage].uniforms);
        assert_int_equal(buffers_seen, want[storage].buffers);
        fixture_free(&fixture);
    }
}

// --- lights that move ------------------------------------------------------------------

static void a_frame_shows_the_phase_that_it_is_given(void **state)
{
    (void)state;
    for (int storage = 0; storage < LIGHT_STORAGES; storage++) {
        struct light_text lights = all;
        struct fixture fixture;
        struct sb_light moved[LIGHTS];
        const struct sb_light *want[SB_LIGHT_STRUCT_COUNT];
        const struct sb_lights of_test = {moved, {DIR, POINT, SPOT, AREA}};
        lights.storage = storage;
        fixture_init(&fixture);
        fixture.variant.value[SB_AXIS_UPDATE] = SB_UPDATE_LIGHTS;
        fixture.variant.value[SB_AXIS_SHADOWS] = 2;
        fixture_make_members(&fixture, &lights);
        assert_int_equal(fixture.binding.phase_count, SB_PHASES);
        const int64_t resting = draw_frame(&fixture, -1);
        want_lists(want, &of_test);
        for (int i = SB_PHASES - 1; i >= 0; i--) {
            const struct sb_phase phase = {i, 2, 1}; // two casters of shadows stand still
            sb_lights_phase(&fixture.world.scene.lights, &phase, moved);
            assert_int_equal(!memcmp(moved, fixture.world.light, sizeof moved), i == 0);
            const int64_t of_upload =
                sb_light_upload_set(&fixture.binding.lights, &fixture.world.scene.lights);
            assert_int_equal(draw_frame(&fixture, i), resting + of_upload);
            check_members(&fixture, &lights, want);
        }
        fixture_free(&fixture);
    }
}

static void casters_move_only_where_their_maps_are_drawn_again(void **state)
{
    (void)state;
    struct sb_variant variant;
    sb_variant_init(sb_axes_builtin(), &variant);
    variant.value[SB_AXIS_SHADOWS] = 3;
    variant.value[SB_AXIS_SCALE] = 7;
    variant.value[SB_AXIS_UPDATE] = SB_UPDATE_LIGHTS;
    assert_int_equal(sb_phase_of(&variant, 5).still_points, 3);
    assert_int_equal(sb_phase_of(&variant, 5).number, 5);
    check_close(sb_phase_of(&variant, 5).scale, 7, 0);
    variant.value[SB_AXIS_UPDATE] = SB_UPDATE_SHADOWS;
    assert_int_equal(sb_phase_of(&variant, 5).still_points, 0);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_member_of_every_light_arrives_in_every_storage),
        cmocka_unit_test(a_program_with_fewer_lights_gets_the_first_of_each_type),
        cmocka_unit_test(lights_that_are_off_are_black_and_come_back),
        cmocka_unit_test(unified_lights_arrive_in_the_order_of_the_whole_list),
        cmocka_unit_test(lights_of_view_space_are_where_the_camera_sees_them),
        cmocka_unit_test(view_space_is_computed_in_double),
        cmocka_unit_test(entries_behind_a_shorter_list_are_off_but_stale_in_the_text),
        cmocka_unit_test(the_entry_of_a_sun_that_has_set_is_off),
        cmocka_unit_test(counts_of_a_dynamic_loop_are_those_of_the_list),
        cmocka_unit_test(an_upload_counts_the_calls_that_reach_the_driver),
        cmocka_unit_test(a_frame_shows_the_phase_that_it_is_given),
        cmocka_unit_test(casters_move_only_where_their_maps_are_drawn_again),
    };
    return run_with_context(tests, sizeof tests / sizeof *tests);
}
