// What the programs "probe" of shipped variants draw and tell, and the geometry picture.
#include "local_probe/probe.h"

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_probe_draws_what_the_timed_program_draws),
        cmocka_unit_test(presets_are_probed_as_they_are_drawn),
        cmocka_unit_test(reduced_precision_is_probed_as_it_is_drawn),
        cmocka_unit_test(loops_that_are_unrolled_less_differ_by_rounding_at_most),
        cmocka_unit_test(inputs_are_told_without_changing_what_is_drawn),
        cmocka_unit_test(inputs_are_those_of_the_whole_probe),
        cmocka_unit_test(lamps_have_a_colour_and_nothing_to_tell),
        cmocka_unit_test(one_pixel_tells_what_the_whole_picture_tells),
        cmocka_unit_test(lights_can_be_off_in_a_probe),
        cmocka_unit_test(a_program_without_a_probe_says_so),
        cmocka_unit_test(geometry_shows_the_draws_of_the_id_image),
        cmocka_unit_test(positions_are_those_of_the_weighted_corners),
        cmocka_unit_test(pages_of_lights_follow_closed_forms),
        cmocka_unit_test(decisions_are_hashed_in_order),
        cmocka_unit_test(a_light_on_the_surface_is_not_finite_in_naive_forms),
        cmocka_unit_test(negative_terms_are_counted),
        cmocka_unit_test(frames_of_normal_maps_are_told),
        cmocka_unit_test(texels_are_told_as_they_were_looked_up),
        cmocka_unit_test(vertices_tell_what_they_hand_on),
    };
    struct sb_error err = {0};
    const struct sb_context_params params = {
        .context = gl_test_context(), .gles = gl_test_gles(), .device = -1};
    probe_runner = probe_fns->open(&params, &probe_caps, &err);
    if (!probe_runner)
        gl_test_unavailable(&err);
    const int failed =
        probe_caps.colour_float ? run_tests(tests) : 77; // no float targets: skipped
    probe_fns->close(probe_runner);
    return failed;
}
