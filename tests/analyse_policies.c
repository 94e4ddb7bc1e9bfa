// Payback in frames, and policies added up over scenes.
#include "test.h"

#include "analyse/policies.h"

static void payback_is_the_longer_set_up_over_what_a_frame_saves(void **state)
{
    (void)state;
    check_close(sb_payback_frames(100, 2), 50, 0);
    check_close(sb_payback_frames(-5, 2), 0, 0);
    check_close(sb_payback_frames(0, 0), 0, 0);
    assert_true(isinf(sb_payback_frames(100, 0)));
    assert_true(isinf(sb_payback_frames(100, -1)));
    assert_true(isnan(sb_payback_frames(-5, -1))); // cheaper first, dearer later
    assert_true(isnan(sb_payback_frames(NAN, 1)));
}

static struct sb_row row_of(const char *scene, const char *variant, const char *hash,
                            double setup, double ms)
{
    struct sb_row row;
    sb_row_init(&row);
    row.scene = scene;
    row.variant = variant;
    row.lit_hash = hash;
    row.compile_ms = setup / 2;
    row.link_ms = setup / 2;
    row.first_draw_ms = row.median_ms = ms;
    row.programs = 1;
    return row;
}

static bool is_policy(const struct sb_variant *variant)
{
    return variant->value[SB_AXIS_SPECIALISE] != SB_SPECIALISE_ASKED;
}

static void totals_count_one_uber_program_once(void **state)
{
    (void)state;
    struct sb_variant uber, scene;
    sb_variant_init(sb_axes_builtin(), &uber);
    scene = uber;
    sb_variant_put(&uber, SB_AXIS_SPECIALISE, SB_SPECIALISE_UBER);
    sb_variant_put(&scene, SB_AXIS_SPECIALISE, SB_SPECIALISE_SCENE);
    struct sb_row row[4] = {
        row_of("a", "u", "one", 100, 4),
        row_of("a", "s", "x", 80, 1),
        row_of("b", "u", "one", 110, 4),
        row_of("b", "s", "y", 90, 2),
    };
    for (int i = 0; i < 4; i++) {
        row[i].axes = i % 2 ? &scene : &uber;
        row[i].against = "u";
        row[i].against_ratio = i % 2 ? row[i].median_ms / 4 : 1;
    }
    struct sb_policy_total total[4];
    assert_int_equal(sb_policy_totals(sb_axes_builtin(), row, 4, is_policy, total), 2);
    assert_true(isnan(total[0].payback_frames)); // itself
    assert_int_equal(total[1].rows, 2);
    assert_int_equal(total[1].programs, 2);
    check_close(total[1].setup_ms, 170, 1e-9);
    check_close(total[1].uber_setup_ms, 110, 1e-9); // made once; the longer time
    check_close(total[1].saved_ms, (3 + 2) / 2.0, 1e-9);
    check_close(total[1].ratio, sqrt(0.25 * 0.5), 1e-12);
    check_close(total[1].payback_frames, 60 / 2.5, 1e-9);
    assert_true(sb_row_against(row, 4, &row[3]) == &row[2]);
    row[3].against = NULL;
    assert_null(sb_row_against(row, 4, &row[3]));
}

static void set_up_is_compiling_linking_and_what_the_first_draw_takes_longer(void **state)
{
    (void)state;
    struct sb_row row = row_of("a", "u", "one", 100, 4);
    check_close(sb_row_setup_ms(&row), 100, 1e-9);
    row.first_draw_ms = 54;
    check_close(sb_row_setup_ms(&row), 150, 1e-9);
    row.first_draw_ms = 1;
    check_close(sb_row_setup_ms(&row), 100, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(payback_is_the_longer_set_up_over_what_a_frame_saves),
        cmocka_unit_test(totals_count_one_uber_program_once),
        cmocka_unit_test(
            set_up_is_compiling_linking_and_what_the_first_draw_takes_longer),
    };
    return run_tests(tests);
}
