#include "test.h"

#include "axis/axis.h"
#include "scene/lights.h"

static int aligned(int offset, int to)
{
    return (offset + to - 1) / to * to;
}

// OpenGL 4.6 core, 7.6.2.2: a float is aligned to 4 bytes (rule 1), a vec3 to 16 (rule
// 3), a struct in an array to 16 (rules 9 and 10). The members leave no hole and do not
// overlap.
static void members_stand_where_std140_puts_them(void **state)
{
    (void)state;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const struct sb_light_type_row *row = &sb_light_types[type];
        int offset = 0, end = 0;
        for (int i = 0; i < row->field_count; i++) {
            const struct sb_light_field *field = &row->field[i];
            assert_true(field->components == 1 || field->components == 3);
            offset = aligned(end, field->components == 3 ? 16 : 4);
            assert_int_equal(offset, end);
            assert_int_equal(field->offset, offset);
            end = offset + 4 * field->components;
        }
        assert_int_equal(aligned(end, 16), row->size);
        assert_int_equal(end, row->size);
    }
}

static void types_name_their_own_axis_and_array(void **state)
{
    (void)state;
    assert_int_equal(sb_light_types[SB_LIGHT_DIR].axis, SB_AXIS_DIR);
    assert_int_equal(sb_light_types[SB_LIGHT_POINT].axis, SB_AXIS_POINT);
    assert_int_equal(sb_light_types[SB_LIGHT_SPOT].axis, SB_AXIS_SPOT);
    assert_string_equal(sb_light_types[SB_LIGHT_DIR].array, "u_dir");
    assert_string_equal(sb_light_types[SB_LIGHT_POINT].array, "u_point");
    assert_string_equal(sb_light_types[SB_LIGHT_SPOT].array, "u_spot");
}

static void a_type_picks_its_own_list(void **state)
{
    (void)state;
    static const struct sb_dir_light dir[1];
    static const struct sb_point_light point[2];
    static const struct sb_spot_light spot[3];
    const struct sb_lights lights = {dir, point, spot, 1, 2, 3};
    int count;
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_DIR, &count), dir);
    assert_int_equal(count, 1);
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_POINT, &count), point);
    assert_int_equal(count, 2);
    assert_ptr_equal(sb_lights_of(&lights, SB_LIGHT_SPOT, &count), spot);
    assert_int_equal(count, 3);
}

static void narrow_cones_keep_full_precision(void **state)
{
    (void)state;
    const double degree = acos(-1.0) / 180;
    static const double outer[] = {0.05, 1, 15, 60, 90, 150};
    for (size_t i = 0; i < sizeof outer / sizeof *outer; i++) {
        struct sb_spot_light light = {0};
        sb_spot_light_set_cone(&light, outer[i] / 2 * degree, outer[i] * degree);
        const long double cosine = cosl((long double)outer[i] * degree);
        check_close(light.cos_cutoff, (double)cosine, 6e-8);
        const double expected = (double)(1 / (1 - cosine));
        check_close(light.inv_one_minus_cos / expected, 1, 6e-8);
    }
}

static void the_smooth_cone_is_one_inside_and_zero_outside(void **state)
{
    (void)state;
    const double inner = 0.3, outer = 0.5;
    struct sb_spot_light light = {0};
    sb_spot_light_set_cone(&light, inner, outer);
    check_close(cos(inner) * light.cone_scale + light.cone_offset, 1, 2e-6);
    check_close(cos(outer) * light.cone_scale + light.cone_offset, 0, 2e-6);
}

static void equal_angles_give_a_steep_ramp_that_ends_at_the_outer_one(void **state)
{
    (void)state;
    struct sb_spot_light light = {0};
    sb_spot_light_set_cone(&light, 0.5, 0.5);
    check_close(light.cone_scale, 1024, 0);
    check_close(cos(0.5) * light.cone_scale + light.cone_offset, 0, 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_stand_where_std140_puts_them),
        cmocka_unit_test(types_name_their_own_axis_and_array),
        cmocka_unit_test(a_type_picks_its_own_list),
        cmocka_unit_test(narrow_cones_keep_full_precision),
        cmocka_unit_test(the_smooth_cone_is_one_inside_and_zero_outside),
        cmocka_unit_test(equal_angles_give_a_steep_ramp_that_ends_at_the_outer_one),
    };
    return run_tests(tests);
}
