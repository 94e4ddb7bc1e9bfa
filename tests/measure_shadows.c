// The time of shadow maps beside that of shading, and their pictures.
#include "measure_fixture.h"

#define SETTINGS(...)                                                                    \
    (const char *const[]){__VA_ARGS__},                                                  \
        (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

static double exact_ns(void *user, const struct sb_job *job, const struct sb_shot *shot,
                       int64_t count)
{
    (void)user;
    (void)shot;
    (void)count;
    return 1e6 + 1e5 * job->variant.value[SB_AXIS_POINT];
}

// Variants of ten and more lights have two casters; those of twenty draw them each frame.
static void some_draw_shadows(void *user, const struct sb_job *job,
                              struct sb_prepared *prepared)
{
    (void)user;
    prepared->casters = job->variant.value[SB_AXIS_POINT] >= 10 ? 2 : 0;
    prepared->draws_shadows = job->variant.value[SB_AXIS_POINT] >= 20;
}

static void begin(struct fixture *f)
{
    next_script.frame_ns = exact_ns;
    next_script.prepare = some_draw_shadows;
    next_script.shadow_share = 0.125;
    fixture_begin(f, "0,10,20", SETTINGS("first_look", "20", "rounds", "20"));
}

static void the_share_of_the_shadow_maps_is_split_off_the_frame_time(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f);
    if (!fixture_run(&f, false))
        fail_msg("%s", f.err.text);
    for (int i = 0; i < 2; i++) {
        assert_true(isnan(f.result.row[i].shadow_ms));
        assert_true(isnan(f.result.row[i].shading_ms));
    }
    check_close(f.result.row[2].median_ms, 3, 1e-9);
    check_close(f.result.row[2].shadow_ms, 3 * 0.125, 1e-9);
    check_close(f.result.row[2].shading_ms, 3 * 0.875, 1e-9);
    fixture_end(&f);
}

static int part_shots;
static int64_t part_frames, whole_frames;

static double count_parts(void *user, const struct sb_job *job,
                          const struct sb_shot *shot, int64_t count)
{
    if (shot->part == SB_PART_SHADOWS) {
        part_shots++;
        part_frames = shot->frames;
    } else if (part_shots < 15) {
        whole_frames = shot->frames;
    }
    return exact_ns(user, job, shot, count);
}

static void at_least_15_pairs_of_batches_of_equal_length_are_taken(void **state)
{
    (void)state;
    struct fixture f;
    part_shots = 0;
    begin(&f);
    next_script.frame_ns = count_parts;
    assert_true(fixture_run(&f, false));
    assert_true(part_shots >= 15);
    // An eighth of the time a frame, so eight times as many.
    assert_int_equal(part_frames, 8 * whole_frames);
    fixture_end(&f);
}

// Levels that wander by a half from pair to pair: a pair ends with its shadow passes. How many
// shots went before, for warming up, is a matter of the machine.
static double wandering(void *user, const struct sb_job *job, const struct sb_shot *shot,
                        int64_t count)
{
    const double level = 1 + 0.5 * sin(part_shots);
    part_shots += shot->part == SB_PART_SHADOWS;
    return exact_ns(user, job, shot, count) * level;
}

static void levels_that_wander_cancel_in_the_pairs(void **state)
{
    (void)state;
    struct fixture f;
    part_shots = 0;
    begin(&f);
    next_script.frame_ns = wandering;
    assert_true(fixture_run(&f, false));
    const struct sb_row *row = &f.result.row[2];
    check_close(row->shadow_ms / row->median_ms, 0.125, 0.02);
    fixture_end(&f);
}

static bool is_in(const struct fixture *f, const char *name)
{
    struct sb_arena arena = {0};
    char *path = sb_arena_printf(&arena, "%s/images/%s", f->dir, name);
    const bool there = sb_file_exists(path);
    sb_arena_free(&arena);
    return there;
}

static void remove_images(const struct fixture *f)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s/images'", f->dir);
    assert_int_equal(system(command), 0);
}

static void every_caster_of_a_variant_has_its_picture(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f);
    if (!fixture_run_with(&f, false, true))
        fail_msg("%s", f.err.text);
    assert_true(is_in(&f, "containers-point=0.png"));
    assert_false(is_in(&f, "containers-point=0-shadow0.png"));
    assert_true(is_in(&f, "containers-point=10-shadow0.png"));
    assert_true(is_in(&f, "containers-point=10-shadow1.png"));
    assert_false(is_in(&f, "containers-point=10-shadow2.png"));
    assert_true(is_in(&f, "containers-point=20-shadow1.png"));
    remove_images(&f);
    fixture_end(&f);
}

static void the_sheet_has_a_legend_in_the_order_of_the_plan(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_arena arena = {0};
    next_script.frame_ns = exact_ns;
    fixture_begin(&f, "1..10", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run_with(&f, false, true));
    assert_true(is_in(&f, "sheet.png"));
    const char *legend =
        sb_file_read(&arena, sb_arena_printf(&arena, "%s/images/sheet.txt", f.dir), 4096,
                     NULL, &f.err);
    assert_non_null(legend);
    check_contains(legend, "row\tcolumn\tscene\tvariant\n"
                           "1\t1\tcontainers\tpoint=1\n"
                           "1\t2\tcontainers\tpoint=2\n");
    check_contains(legend, "1\t8\tcontainers\tpoint=8\n"
                           "2\t1\tcontainers\tpoint=9\n"
                           "2\t2\tcontainers\tpoint=10\n");
    sb_arena_free(&arena);
    remove_images(&f);
    fixture_end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_share_of_the_shadow_maps_is_split_off_the_frame_time),
        cmocka_unit_test(at_least_15_pairs_of_batches_of_equal_length_are_taken),
        cmocka_unit_test(levels_that_wander_cancel_in_the_pairs),
        cmocka_unit_test(every_caster_of_a_variant_has_its_picture),
        cmocka_unit_test(the_sheet_has_a_legend_in_the_order_of_the_plan),
    };
    return run_tests(tests);
}
