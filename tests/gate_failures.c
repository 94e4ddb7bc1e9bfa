// What cannot be compared fails alone, with its status and exit code; the others are judged.
#include "gate_fixture.h"

// --- scripts ---------------------------------------------------------------------------------

static void refuse_head_0(void *user, const struct sb_job *job,
                          struct sb_prepared *prepared)
{
    (void)user;
    if (variant_of(job->id) != 0 || !is_head(job->id))
        return;
    prepared->log = strdup("0:7(3): error: syntax error, unexpected '}'");
    prepared->failed_stage = SB_STAGE_FRAG;
    sb_fail(&prepared->error, SB_COMPILE_FAILED, "the driver refused it");
}

static void refuse_base_1(void *user, const struct sb_job *job,
                          struct sb_prepared *prepared)
{
    (void)user;
    if (variant_of(job->id) == 1 && !is_head(job->id))
        sb_fail(&prepared->error, SB_COMPILE_FAILED, "base is broken");
}

// In the first session only: the confirmation finds a program that does not compile.
static void refuse_fresh(void *user, const struct sb_job *job,
                         struct sb_prepared *prepared)
{
    (void)user, (void)job;
    if (script.opened > 1)
        sb_fail(&prepared->error, SB_COMPILE_FAILED, "not twice");
}

// Head's picture: black, not a number, another one.
static float colour_of_head(uint32_t job, float wrong)
{
    return is_head(job) && variant_of(job) == 1 ? wrong : 0.5f;
}
static float black(void *user, const struct sb_job *job,
                   const struct sb_image_request *request)
{
    (void)user, (void)request;
    return colour_of_head(job->id, 0);
}
static float not_a_number(void *user, const struct sb_job *job,
                          const struct sb_image_request *request)
{
    (void)user, (void)request;
    return colour_of_head(job->id, NAN);
}
static float brighter(void *user, const struct sb_job *job,
                      const struct sb_image_request *request)
{
    (void)user, (void)request;
    return colour_of_head(job->id, 5);
}
static float base_black(void *user, const struct sb_job *job,
                        const struct sb_image_request *request)
{
    (void)user, (void)request;
    return !is_head(job->id) && variant_of(job->id) == 1 ? 0 : 0.5f;
}

// --- tests -----------------------------------------------------------------------------------

static void a_head_that_does_not_compile_is_invalid_and_the_others_are_judged(
    void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.prepare = refuse_head_0;
    script.slower[2] = script.slower_fresh[2] = 0.08;
    gate_run_good(&gate);
    check_row(&gate, 0, "invalid", "compile_failed");
    assert_string_equal(gate.result.row[0].status_of, "head");
    check_contains(gate.result.row[0].note, "head: ");
    check_contains(gate.result.row[0].note, "syntax error");
    assert_int_equal(gate.result.row[0].pairs, SB_NO_COUNT);
    check_row(&gate, 1, "pass", "ok");
    assert_null(gate.result.row[1].status_of);
    check_row(&gate, 2, "regression", "ok");
    assert_int_equal(gate.result.exit_code, 3);     // 3 weighs more than 1
    assert_int_equal(gate.result.rule.variants, 2); // of those that are timed
    gate_end(&gate);
}

static void what_base_alone_gets_wrong_is_no_fault_of_head(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct gate gate;
        gate_begin(&gate);
        script.noise = 0.01;
        if (i == 0)
            script.prepare = refuse_base_1;
        else
            script.colour = base_black;
        gate_run_good(&gate);
        check_row(&gate, 0, "pass", "ok");
        check_row(&gate, 1, "invalid", i == 0 ? "compile_failed" : "blank_picture");
        assert_string_equal(gate.result.row[1].status_of, "base");
        check_contains(gate.result.row[1].note, "base: ");
        assert_int_equal(gate.result.exit_code, 0);
        gate_end(&gate);
    }
}

static void a_wrong_picture_of_head_is_never_timed(void **state)
{
    (void)state;
    static const struct {
        float (*colour)(void *, const struct sb_job *, const struct sb_image_request *);
        const char *status, *part;
        int code;
    } cases[] = {
        {black, "blank_picture", "every covered pixel is black", 3},
        {not_a_number, "non_finite", "NaN or infinite", 3},
        {brighter, "worse_picture", "max error ", 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct gate gate;
        gate_begin(&gate);
        script.noise = 0.01;
        script.colour = cases[i].colour;
        gate_run_good(&gate);
        check_row(&gate, 0, "pass", "ok");
        check_row(&gate, 1, "invalid", cases[i].status);
        check_row(&gate, 2, "pass", "ok");
        check_contains(gate.result.row[1].note, cases[i].part);
        assert_int_equal(gate.result.row[1].pairs, SB_NO_COUNT);
        assert_int_equal(gate.result.exit_code, cases[i].code);
        gate_end(&gate);
    }
}

// On the null runner only FLIP can tell: nothing there is drawn where the reference expects it.
static void a_worse_picture_says_where_and_by_how_much(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.colour = brighter;
    gate_run_good(&gate);
    const struct sb_gate_row *row = &gate.result.row[1];
    assert_string_equal(row->picture, "worse");
    check_contains(row->note, " at (");
    check_contains(row->note, "FLIP");
    gate_end(&gate);
}

static unsigned disjoint_head_1(void *user, const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)count;
    return is_head(shot->job) && variant_of(shot->job) == 1 ? SB_SAMPLE_DISJOINT : 0;
}

static unsigned disjoint_head_0(void *user, const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)count;
    return shot->job == 2 ? SB_SAMPLE_DISJOINT : 0;
}

static unsigned every_third(void *user, const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)shot;
    return count % 3 == 0 ? SB_SAMPLE_DISJOINT : 0;
}
static unsigned every_twelfth(void *user, const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)shot;
    return count % 12 == 0 ? SB_SAMPLE_DISJOINT : 0;
}

static void samples_without_a_time_make_a_variant_invalid(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.flags = disjoint_head_1;
    gate_run_good(&gate);
    check_row(&gate, 0, "pass", "ok");
    check_row(&gate, 1, "invalid", "samples_invalid");
    assert_int_equal(gate.result.exit_code, 3);
    gate_end(&gate);
}

// A pair of which a half is flagged is on disk, counts for nothing, and is taken again.
static void flagged_pairs_are_kept_in_the_file_and_not_judged(void **state)
{
    (void)state;
    struct gate gate;
    struct sb_csv csv;
    int count, flagged = 0, whole = 0;
    gate_begin(&gate);
    script.noise = 0.01;
    script.flags = every_twelfth;
    gate_run_good(&gate);
    struct sb_pair_row *pair = read_pairs(&gate, &count, &csv);
    for (int i = 0; i < count; i++) {
        const bool bad = pair[i].base_flags || pair[i].head_flags;
        assert_true(!pair[i].base_flags == (pair[i].base != SB_NO_COUNT));
        assert_true(!pair[i].head_flags == (pair[i].head != SB_NO_COUNT));
        flagged += bad;
        whole += !bad;
    }
    assert_true(flagged > 0 && 10 * flagged > whole);
    int judged = 0;
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "pass", "ok");
        judged += (int)gate.result.row[i].pairs;
    }
    assert_int_equal(judged, whole);
    free(pair);
    sb_csv_free(&csv);
    gate_end(&gate);
}

// What is left when most are flagged is no sample of what was there.
static void where_most_pairs_are_flagged_nothing_passes(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.flags = every_third;
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "invalid", "samples_invalid");
        check_contains(gate.result.row[i].note, "pairs have no time");
    }
    assert_int_equal(gate.result.exit_code, 3);
    gate_end(&gate);
}

static bool later_fails(void *user, int64_t round)
{
    (void)user;
    return round > 60;
}

static void a_driver_that_fails_in_the_rounds_fails_what_was_not_decided(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.03;
    script.round_fails = later_fails;
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "invalid", "gl_error");
        assert_in_range(gate.result.row[i].pairs, 1, 30); // what was measured is told
        assert_true(isfinite(gate.result.row[i].ratio));
    }
    assert_int_equal(gate.result.exit_code, 3);
    gate_end(&gate);
}

static void a_candidate_that_cannot_be_measured_again_is_inconclusive(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.slower[1] = 0.05;
    script.prepare = refuse_fresh;
    gate_run_good(&gate);
    check_row(&gate, 1, "inconclusive", "ok");
    check_contains(gate.result.row[1].note, "a fresh process gave 0 of 120 pairs");
    check_contains(gate.result.row[1].note, "not twice");
    assert_true(isnan(gate.result.row[1].confirm_ratio));
    assert_int_equal(gate.result.exit_code, 0);
    gate_end(&gate);
}

// However many frames: as long as one. And a small frame, of which the most is waiting.
static double dropped_draws(void *user, const struct sb_job *job,
                            const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)job, (void)count;
    return 20 * 4e6 / shot->frames;
}
static double mostly_waiting(void *user, const struct sb_job *job,
                             const struct sb_shot *shot, int64_t count)
{
    (void)user, (void)job, (void)count;
    // 140 ms once a batch, 20 ms of pixels a frame, of which CPU time is a tenth; the runner divides
    // by the pixels left out.
    const double pixels = 20e6 / (shot->shrink * shot->shrink);
    return (140e6 / shot->frames + pixels) * (shot->shrink * shot->shrink);
}
static double (*frame_of_all)(void *, const struct sb_job *, const struct sb_shot *,
                              int64_t);
static void *open_dropping(const struct sb_context_params *params, struct sb_caps *caps,
                           struct sb_error *err)
{
    void *runner = open_scripted(params, caps, err);
    sb_null_script(runner)->frame_ns = frame_of_all;
    return runner;
}

static void a_metric_that_does_not_see_all_of_the_work_gives_no_verdict(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    scripted_runner.open = open_dropping;
    frame_of_all = dropped_draws;
    gate.params.metric = SB_METRIC_CPU;
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "invalid", "no_credible_timer");
        check_contains(gate.result.row[i].note, "draws were dropped");
        assert_string_equal(gate.result.row[i].picture,
                            "equal"); // which was found before
    }
    assert_int_equal(gate.result.exit_code, 3);
    gate_end(&gate);

    gate_begin(&gate); // a cost of waiting is no dropped draw
    scripted_runner.open = open_dropping;
    frame_of_all = mostly_waiting;
    gate.params.metric = SB_METRIC_CPU;
    gate_run_good(&gate);
    check_row(&gate, 0, "pass", "ok");
    gate_end(&gate);
}

static void one_variant_without_times_does_not_end_a_gate_by_cpu_time(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.flags = disjoint_head_0; // of the pair that would prove the metric
    script.noise = 0.01;
    gate.params.metric = SB_METRIC_CPU;
    gate_run_good(&gate);
    check_row(&gate, 0, "invalid", "samples_invalid");
    check_row(&gate, 1, "pass", "ok");
    check_row(&gate, 2, "pass", "ok");
    assert_int_equal(gate.result.exit_code, 3);
    gate_end(&gate);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            a_head_that_does_not_compile_is_invalid_and_the_others_are_judged),
        cmocka_unit_test(what_base_alone_gets_wrong_is_no_fault_of_head),
        cmocka_unit_test(a_wrong_picture_of_head_is_never_timed),
        cmocka_unit_test(a_worse_picture_says_where_and_by_how_much),
        cmocka_unit_test(samples_without_a_time_make_a_variant_invalid),
        cmocka_unit_test(flagged_pairs_are_kept_in_the_file_and_not_judged),
        cmocka_unit_test(where_most_pairs_are_flagged_nothing_passes),
        cmocka_unit_test(a_driver_that_fails_in_the_rounds_fails_what_was_not_decided),
        cmocka_unit_test(a_candidate_that_cannot_be_measured_again_is_inconclusive),
        cmocka_unit_test(a_metric_that_does_not_see_all_of_the_work_gives_no_verdict),
        cmocka_unit_test(one_variant_without_times_does_not_end_a_gate_by_cpu_time),
    };
    return run_tests(tests);
}
