// The shipped lighting against closed forms in double, and against itself: what one light adds,
// by law, shape, side and map (light_relations/laws.c, shapes.c, normal_map.c), and what must
// stay the same when lights are put otherwise (relations.c).
#include "light_relations/relations.h"

#include "gl_test.h"

struct sb_caps relations_caps;

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attenuation_follows_its_closed_form),
        cmocka_unit_test(the_pole_of_an_inverse_distance_is_cut_off),
        cmocka_unit_test(cones_follow_their_closed_forms),
        cmocka_unit_test(a_cone_of_more_than_a_right_angle_lights_behind_itself),
        cmocka_unit_test(a_wall_that_faces_away_shows_highlights_where_asked),
        cmocka_unit_test(ambient_light_is_of_the_scene_of_each_light_or_none),
        cmocka_unit_test(models_follow_their_closed_forms),
        cmocka_unit_test(directional_lights_may_be_of_any_length),
        cmocka_unit_test(area_lights_shine_from_their_nearest_point),
        cmocka_unit_test(highlights_come_from_the_point_nearest_to_the_reflected_ray),
        cmocka_unit_test(area_lights_of_no_size_are_point_lights),
        cmocka_unit_test(boxes_stay_along_the_axes_of_the_world_in_view_space),
        cmocka_unit_test(a_flat_normal_map_is_none),
        cmocka_unit_test(a_texel_turns_the_normal_in_the_frame_of_the_surface),
        cmocka_unit_test(a_mirrored_frame_turns_it_the_other_way),
        cmocka_unit_test(a_frame_without_room_leaves_the_normal_alone),
        cmocka_unit_test(a_texel_that_is_too_long_lies_in_the_surface),
        cmocka_unit_test(the_order_of_lights_does_not_matter),
        cmocka_unit_test(half_lights_make_a_whole_one),
        cmocka_unit_test(the_light_of_several_is_the_sum_of_each),
        cmocka_unit_test(powers_of_two_scale_pictures_exactly),
        cmocka_unit_test(later_phases_show_lights_that_moved),
        cmocka_unit_test(a_list_that_gets_shorter_leaves_nothing_behind_but_by_the_slip),
        cmocka_unit_test(the_struct_for_all_types_carries_spot_members_that_nobody_reads),
    };
    struct gl_test test;
    gl_test_open(&test);
    relations_caps = test.caps;
    if (!test.caps.colour_float) {
        fprintf(stderr, "skipped: no float targets\n");
        gl_test_close(&test);
        return 77;
    }
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
