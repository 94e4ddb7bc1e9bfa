// A whole run on the null runner: order of calls, stopping, failures, files, resuming.
#include "measure_fixture.h"

#include <signal.h>

#include "measure/interrupt.h"

#define SETTINGS(...)                                                                    \
    (const char *const[]){__VA_ARGS__},                                                  \
        (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

// Times known beforehand: 1 ms and 0.1 ms a point light, exactly.
static double exact_ns(void *user, const struct sb_job *job, const struct sb_shot *shot,
                       int64_t count)
{
    (void)user;
    (void)shot;
    (void)count;
    return 1e6 + 1e5 * job->variant.value[SB_AXIS_POINT];
}

static void the_rows_tell_the_scripted_times(void **state)
{
    (void)state;
    struct fixture f;
    next_script.frame_ns = exact_ns;
    fixture_begin(&f, "0,10,20", SETTINGS("budget", "5"));
    if (!fixture_run(&f, false))
        fail_msg("%s", f.err.text);
    assert_int_equal(f.result.row_count, 3);
    assert_int_equal(f.result.exit_code, 0);
    assert_int_equal(f.result.processes_done, 1);
    for (int i = 0; i < 3; i++) {
        const struct sb_row *row = &f.result.row[i];
        assert_string_equal(row->status, "ok");
        assert_string_equal(row->stop, "half_width");
        check_close(row->median_ms, 1 + i, 1e-9);
        check_close(row->ci_lo_ms, 1 + i, 1e-9);
        check_close(row->fps, 1000.0 / (1 + i), 1e-6);
        check_close(row->ratio, 1 + i, 1e-9);
        check_close(row->ns_per_fragment, (1 + i) * 1e6 / 40000, 1e-6);
        assert_string_equal(row->ci_kind, "ci95_within_run");
        assert_int_equal(row->rounds, 60);
        assert_true(row->batch == (i < 1 ? 2 : 1)); // batches of 2 ms
    }
    fixture_end(&f);
}

static void the_calls_come_in_the_order_of_the_method(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_text log = {0};
    next_script.frame_ns = exact_ns;
    next_script.log = &log;
    fixture_begin(&f, "1,2", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    // Audit and probe before anything is prepared; all is prepared and checked before a
    // shot; nothing is prepared after.
    const char *const order[] = {"audit",     "probe", "use_timer", "prepare 1",
                                 "prepare 2", "image", "round"};
    const char *at = log.data;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        at = strstr(at, order[i]);
        assert_non_null(at);
    }
    assert_null(strstr(at, "prepare"));
    assert_null(strstr(at, "image"));
    fixture_end(&f);
    check_contains(log.data, "release 1\nrelease 2\nclose");
    sb_text_free(&log);
}

static void every_round_has_every_variant_once_and_places_change(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_csv csv;
    fixture_begin(&f, "0..4", SETTINGS("first_look", "40", "rounds", "40"));
    assert_true(fixture_run(&f, false));
    fixture_samples(&f, &csv);
    assert_int_equal(csv.row_count - 1, 40 * 5);
    const int variant = sb_csv_column(&csv, "variant"),
              place = sb_csv_column(&csv, "place");
    const int round = sb_csv_column(&csv, "round");
    int places_of_first[5] = {0};
    for (int r = 0; r < 40; r++)
        for (int i = 0; i < 5; i++) {
            char **cell = csv.cell[1 + r * 5 + i];
            assert_int_equal(atoi(cell[round]), r);
            assert_int_equal(atoi(cell[place]), i);
            for (int j = 0; j < i; j++)
                assert_string_not_equal(cell[variant], csv.cell[1 + r * 5 + j][variant]);
            places_of_first[i] += strcmp(cell[variant], "point=0") == 0;
        }
    for (int i = 0; i < 5; i++)
        assert_int_equal(places_of_first[i],
                         8); // a Latin square: each place equally often
    sb_csv_free(&csv);
    fixture_end(&f);
}

// Ten times noisier with ten lights.
static double noisy_ns(void *user, const struct sb_job *job, const struct sb_shot *shot,
                       int64_t count)
{
    (void)user;
    (void)shot;
    const double share = job->variant.value[SB_AXIS_POINT] > 0 ? 0.5 : 0.001;
    return 1e6 * (1 + share * sin((double)count * 1.7));
}

static void precise_variants_stop_and_noisy_ones_go_on(void **state)
{
    (void)state;
    struct fixture f;
    next_script.frame_ns = noisy_ns;
    fixture_begin(&f, "0,10", SETTINGS("first_look", "10", "rounds", "50"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].stop, "half_width");
    assert_string_equal(f.result.row[1].stop, "rounds");
    assert_true(f.result.row[0].rounds < 50);
    assert_int_equal(f.result.row[1].rounds, 50);
    fixture_end(&f);
}

static void the_budget_ends_a_run(void **state)
{
    (void)state;
    struct fixture f;
    next_script.frame_ns = noisy_ns;
    fixture_begin(&f, "10,11",
                  SETTINGS("rounds", "1000000", "budget", "0.2", "half_width", "0.0001"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].stop, "budget");
    fixture_end(&f);
}

static void fail_to_compile(void *user, const struct sb_job *job,
                            struct sb_prepared *prepared)
{
    (void)user;
    if (job->variant.value[SB_AXIS_POINT] == 2) {
        sb_fail(&prepared->error, SB_COMPILE_FAILED, "fragment shader");
        prepared->failed_stage = SB_STAGE_FRAG;
        prepared->log = sb_strdup("0:1(1): error: scripted\n");
    }
}

static void a_variant_that_fails_to_compile_costs_only_its_row(void **state)
{
    (void)state;
    struct fixture f;
    next_script.prepare = fail_to_compile;
    fixture_begin(&f, "1,2,3", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_int_equal(f.result.exit_code, 3);
    assert_string_equal(f.result.row[1].status, "compile_failed");
    check_contains(f.result.row[1].note, "error: scripted");
    assert_true(isnan(f.result.row[1].median_ms));
    assert_string_equal(f.result.row[0].status, "ok");
    assert_string_equal(f.result.row[2].status, "ok");
    fixture_end(&f);
}

static float nan_colour(void *user, const struct sb_job *job,
                        const struct sb_image_request *request)
{
    (void)user;
    (void)request;
    return job->variant.value[SB_AXIS_POINT] == 2 ? NAN
                                                  : 0.25f + 0.01f * request->off_count;
}

static void a_picture_with_nan_is_not_timed(void **state)
{
    (void)state;
    struct fixture f;
    next_script.colour = nan_colour;
    fixture_begin(&f, "1,2", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[1].status, "non_finite");
    assert_int_equal(f.result.row[1].nonfinite, 64 * 64 * 3);
    assert_true(isnan(f.result.row[1].median_ms));
    assert_int_equal(f.result.exit_code, 3);
    fixture_end(&f);
}

// Whatever such a picture shows, it says nothing of the driver: neither that the values are no
// numbers, nor that a light changes nothing.
static void a_picture_that_the_text_leaves_undefined_is_timed_and_not_judged(void **state)
{
    (void)state;
    const struct sb_assignment sets[] = {{"source", "ubo", "--set"},
                                         {"text", "as_written", "--set"},
                                         {"model", "phong", "--set"},
                                         {"point", "2", "--set"}};
    const struct sb_suite_params params = {.set = sets, .set_count = 4};
    struct fixture f;
    next_script.colour = nan_colour;
    fixture_begin_suite(&f, &params, SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].status, "ok");
    check_contains(f.result.row[0].note, "nothing has set: the picture may be anything");
    assert_true(f.result.row[0].median_ms > 0);
    assert_int_equal(f.result.exit_code, 0);
    fixture_end(&f);
}

// Each variant another picture: with storage varied they are one class, and must not differ.
static float colour_of_job(void *user, const struct sb_job *job,
                           const struct sb_image_request *request)
{
    (void)user;
    return 0.25f + 0.01f * (float)job->id + 0.001f * (float)request->off_count;
}

static void a_class_that_draws_two_pictures_is_refused(void **state)
{
    (void)state;
    struct fixture f;
    next_script.colour = colour_of_job;
    fixture_begin_axis(&f, "storage", "uniform,ubo_std140", SETTINGS("rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].status, "ok");
    assert_string_equal(f.result.row[1].status, "class_broken");
    // Both variants, the pixel and both values.
    check_contains(
        f.result.row[1].note,
        "storage=ubo_std140 differs from storage=uniform by 0.01 at pixel (0, 0) "
        "of 48 x 48, and should not: red is 0.270000011, not 0.25999999");
    check_close(f.result.row[1].class_spread, 0.01, 1e-6);
    assert_true(isnan(f.result.row[0].class_spread));
    assert_int_equal(f.result.exit_code, 3);
    fixture_end(&f);
}

static void variants_of_other_classes_may_differ(void **state)
{
    (void)state;
    struct fixture f;
    next_script.colour = colour_of_job;
    fixture_begin_axis(&f, "model", "lambert,blinn",
                       SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[1].status, "ok");
    assert_true(isnan(f.result.row[1].class_spread));
    fixture_end(&f);
}

static float black(void *user, const struct sb_job *job,
                   const struct sb_image_request *request)
{
    (void)user;
    (void)job;
    (void)request;
    return 0;
}

static void a_black_picture_is_not_timed(void **state)
{
    (void)state;
    struct fixture f;
    next_script.colour = black;
    fixture_begin(&f, "1", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].status, "blank_picture");
    fixture_end(&f);
}

// Light 5 of the list does nothing: leaving out a group changes the picture only by the
// others of the group.
static float without_light_5(void *user, const struct sb_job *job,
                             const struct sb_image_request *request)
{
    (void)user;
    float colour = 0.5f;
    for (int i = 0; i < (int)job->variant.value[SB_AXIS_POINT]; i++)
        if (i != 5 &&
            !(i >= request->off_first && i < request->off_first + request->off_count))
            colour += 0.01f;
    return colour;
}

static void a_dead_light_is_found_and_named(void **state)
{
    (void)state;
    struct fixture f;
    next_script.colour = without_light_5;
    fixture_begin(&f, "8", SETTINGS("first_look", "20", "rounds", "20"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].status, "dead_light");
    check_contains(f.result.row[0].note, "point light 5 changes no pixel");
    assert_int_equal(f.result.exit_code, 3);
    fixture_end(&f);
}

static unsigned mostly_disjoint(void *user, const struct sb_shot *shot, int64_t count)
{
    (void)user;
    (void)shot;
    return count % 2 ? SB_SAMPLE_DISJOINT : 0;
}

static void flagged_samples_are_kept_on_disk_and_enter_no_estimate(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_csv csv;
    next_script.flags = mostly_disjoint;
    fixture_begin(&f, "1", SETTINGS("first_look", "40", "rounds", "40"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].status, "samples_invalid");
    assert_int_equal(f.result.row[0].rounds, 20);
    fixture_samples(&f, &csv);
    assert_int_equal(csv.row_count - 1, 40);
    sb_csv_free(&csv);
    fixture_end(&f);
}

static bool round_fails_after_some(void *user, int64_t round)
{
    (void)user;
    return round == 70;
}

static void a_driver_that_dies_in_a_round_costs_that_round_only(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_csv csv;
    next_script.round_fails = round_fails_after_some;
    fixture_begin(&f, "1,2", SETTINGS("first_look", "60", "rounds", "60"));
    assert_true(fixture_run(&f, false));
    assert_string_equal(f.result.row[0].status, "gl_error");
    assert_int_equal(f.result.exit_code, 3);
    fixture_samples(&f, &csv);
    assert_true(csv.row_count > 1);
    assert_int_equal((csv.row_count - 1) % 2, 0);
    assert_true(f.result.row[0].median_ms > 0); // what was measured is shown
    sb_csv_free(&csv);
    fixture_end(&f);
}

static void without_a_credible_timer_nothing_is_measured(void **state)
{
    (void)state;
    struct fixture f;
    next_script.no_credible_timer = true;
    fixture_begin(&f, "1", SETTINGS("rounds", "4"));
    assert_false(fixture_run(&f, false));
    assert_int_equal(f.err.status, SB_NO_TIMER);
    check_contains(f.err.text, "scripted");
    fixture_end(&f);
}

static void other_inputs(void *user, const struct sb_job *job,
                         struct sb_prepared *prepared)
{
    (void)job;
    prepared->input_hash = *(uint64_t *)user;
}

static void a_process_that_would_draw_something_else_is_refused(void **state)
{
    (void)state;
    struct fixture f;
    uint64_t hash = 7;
    next_script.prepare = other_inputs;
    next_script.user = &hash;
    fixture_begin(&f, "1",
                  SETTINGS("first_look", "20", "rounds", "20", "processes", "3"));
    assert_true(fixture_run(&f, false));
    hash = 8;
    assert_false(fixture_run(&f, true));
    assert_int_equal(f.err.status, SB_BAD_INPUT);
    check_contains(f.err.text, "point=1: the scene has other values");
    hash = 7;
    assert_true(fixture_run(&f, true));
    fixture_end(&f);
}

// Rises by 1 % with every process.
static double level_of_process(void *user, const struct sb_job *job,
                               const struct sb_shot *shot, int64_t count)
{
    (void)job;
    (void)shot;
    (void)count;
    return 1e6 * *(double *)user;
}

static void two_processes_give_the_interval_between_them(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_csv csv;
    double level = 1;
    next_script.frame_ns = level_of_process;
    next_script.user = &level;
    fixture_begin(&f, "1,2",
                  SETTINGS("first_look", "10", "rounds", "10", "processes", "2"));
    assert_true(fixture_run(&f, false));
    assert_int_equal(f.result.processes_done, 1);
    level = 1.01;
    assert_true(fixture_run(&f, true));
    assert_int_equal(f.result.processes_done, 2);
    const struct sb_row *row = &f.result.row[0];
    assert_string_equal(row->ci_kind, "ci95_between_processes");
    assert_int_equal(row->processes, 2);
    check_close(row->median_ms, sqrt(1.01), 1e-9); // geometric mean
    // t(0.975, 1) = 12.706: half-width 12.706 ln(1.01) / 2 on the logarithms.
    check_close(log(row->ci_hi_ms / row->median_ms), 12.7062 * log(1.01) / 2, 1e-4);
    check_close(row->mad_ms, 0, 1e-12); // levels are no spread
    fixture_samples(&f, &csv);
    assert_int_equal(csv.row_count - 1, 2 * 2 * 10);
    assert_string_equal(csv.cell[1][sb_csv_column(&csv, "process")], "0");
    assert_string_equal(csv.cell[40][sb_csv_column(&csv, "process")], "1");
    sb_csv_free(&csv);
    fixture_end(&f);
}

static double interrupt_at_shot(void *user, const struct sb_job *job,
                                const struct sb_shot *shot, int64_t count)
{
    if (count == *(int64_t *)user)
        raise(SIGINT);
    // Steady at first, so that warming up ends before the rounds begin.
    return count < 60 ? 1e6 : noisy_ns(NULL, job, shot, count);
}

// Last, since the interrupt flag of the process stays set.
static void an_interrupted_run_keeps_its_rounds_and_says_so(void **state)
{
    (void)state;
    struct fixture f;
    struct sb_csv csv;
    int64_t at = 400;
    next_script.frame_ns = interrupt_at_shot;
    next_script.user = &at;
    fixture_begin(&f, "0,10,11", SETTINGS("rounds", "100000", "first_look", "20"));
    assert_true(fixture_run(&f, false));
    assert_true(f.result.interrupted);
    assert_int_equal(f.result.exit_code, 130);
    assert_string_equal(f.result.row[0].stop, "half_width");
    assert_string_equal(f.result.row[1].stop, "interrupted");
    fixture_samples(&f, &csv);
    assert_int_equal(csv.row_count - 1, f.result.row[0].rounds + f.result.row[1].rounds +
                                            f.result.row[2].rounds);
    sb_csv_free(&csv);
    json_t *run = sb_store_read_run(f.dir, &f.err);
    const json_t *process = json_array_get(json_object_get(run, "processes"), 0);
    assert_true(json_is_false(json_object_get(process, "complete")));
    json_decref(run);
    fixture_end(&f);
}

int main(void)
{
    sb_interrupt_install();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rows_tell_the_scripted_times),
        cmocka_unit_test(the_calls_come_in_the_order_of_the_method),
        cmocka_unit_test(every_round_has_every_variant_once_and_places_change),
        cmocka_unit_test(precise_variants_stop_and_noisy_ones_go_on),
        cmocka_unit_test(the_budget_ends_a_run),
        cmocka_unit_test(a_variant_that_fails_to_compile_costs_only_its_row),
        cmocka_unit_test(a_picture_with_nan_is_not_timed),
        cmocka_unit_test(
            a_picture_that_the_text_leaves_undefined_is_timed_and_not_judged),
        cmocka_unit_test(a_class_that_draws_two_pictures_is_refused),
        cmocka_unit_test(variants_of_other_classes_may_differ),
        cmocka_unit_test(a_black_picture_is_not_timed),
        cmocka_unit_test(a_dead_light_is_found_and_named),
        cmocka_unit_test(flagged_samples_are_kept_on_disk_and_enter_no_estimate),
        cmocka_unit_test(a_driver_that_dies_in_a_round_costs_that_round_only),
        cmocka_unit_test(without_a_credible_timer_nothing_is_measured),
        cmocka_unit_test(a_process_that_would_draw_something_else_is_refused),
        cmocka_unit_test(two_processes_give_the_interval_between_them),
        cmocka_unit_test(an_interrupted_run_keeps_its_rounds_and_says_so),
    };
    return run_tests(tests);
}
