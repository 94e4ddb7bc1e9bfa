// The anchor, and what a history measures against it, on the null runner.
#include "test.h"

#include <signal.h>
#include <unistd.h>

#include "base/file.h"
#include "base/log.h"
#include "gate/history.h"
#include "job/null.h"
#include "measure/interrupt.h"

enum { PAIRS = 60, SHOTS = 4096 };

// The anchor is job 1, the suite's variants have even numbers (gate/sides.c).
static bool is_anchor(uint32_t job)
{
    return job == 1;
}

static struct sb_suite suite;
static struct sb_anchor anchor;
static struct sb_history_measured measured;
static struct sb_error err;

static struct sb_null_script next_script;
static int opened;
static struct {
    uint32_t job;
    int frames;
} shot[SHOTS];
static int shots;

static void *open_with_script(const struct sb_context_params *params,
                              struct sb_caps *caps, struct sb_error *failure)
{
    void *runner = sb_runner_null.open(params, caps, failure);
    *sb_null_script(runner) = next_script;
    opened++;
    shots = 0;
    return runner;
}

// A frame of the anchor takes 0.4 ms, of a variant 1 ms, and in each process a tenth more than in
// the one before; both drift.
static double frame_ns(void *user, const struct sb_job *job, const struct sb_shot *asked,
                       int64_t count)
{
    (void)user;
    assert_true(shots < SHOTS);
    shot[shots].job = job->id;
    shot[shots++].frames = asked->frames;
    return (is_anchor(job->id) ? 4e5 : 1e6 * pow(1.1, opened - 1)) *
           (1.001 + 1e-4 * (double)count);
}

static int start(void **state)
{
    (void)state;
    const struct sb_assignment sweep = {"point", "1,2,4", "test"};
    sb_log_set_level(SB_LOG_QUIET);
    unsetenv("LP_NUM_THREADS");
    opened = 0;
    next_script = (struct sb_null_script){.frame_ns = frame_ns};
    if (!sb_suite_load(&(struct sb_suite_params){.sweep = &sweep, .sweep_count = 1},
                       &suite, &err) ||
        !sb_anchor_load(SB_SOURCE_DIR, &suite, false, &anchor, &err))
        fail_msg("%s", err.text);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    sb_history_measured_free(&measured);
    sb_anchor_free(&anchor);
    sb_suite_free(&suite);
    return 0;
}

static bool measure_from(const char *shaders, double processes)
{
    static struct sb_runner_fns runner;
    runner = sb_runner_null;
    runner.open = open_with_script;
    suite.measure.processes = processes;
    return sb_history_measure(
        &(struct sb_history_measure_params){
            .suite = &suite,
            .anchor = &anchor,
            .driver = {.runner = &runner, .context = {.context = "null", .device = -1}},
            .pairs = PAIRS,
            .data_dir = SB_SOURCE_DIR,
            .shaders = shaders,
        },
        &measured, &err);
}

static void measure(double processes)
{
    if (!measure_from(NULL, processes))
        fail_msg("%s", err.text);
    assert_int_equal(measured.row_count, suite.entry_count);
}

// --- the anchor --------------------------------------------------------------------------------

// Whoever edits a file of it starts another anchor, and with it new series: then, and only then,
// these numbers change.
static void the_files_of_the_anchor_are_what_they_always_were(void **state)
{
    (void)state;
    static const uint64_t hashes[] = {UINT64_C(0x96b42322d9df3184),
                                      UINT64_C(0xbcc41220ff3036de)};
    for (int gles = 0; gles < 2; gles++) {
        struct sb_anchor other = {0};
        assert_true(sb_anchor_load(SB_SOURCE_DIR, &suite, gles, &other, &err));
        if (other.hash != hashes[gles])
            fail_msg("the anchor's hash is %016llx", (unsigned long long)other.hash);
        sb_anchor_free(&other);
    }
}

static void an_anchor_of_another_scene_is_another_anchor(void **state)
{
    (void)state;
    assert_true(sb_anchor_mark(&anchor, 1) != sb_anchor_mark(&anchor, 2));
    assert_true(sb_anchor_mark(&anchor, 1) != anchor.hash);
}

static void read_repository(const char *name, struct sb_arena *arena, const char **text)
{
    *text = sb_file_read(arena, sb_path_join(arena, SB_SOURCE_DIR "/bench/anchor", name),
                         1 << 20, NULL, &err);
    assert_non_null(*text);
}

static void check_texts(void *user, const struct sb_job *job,
                        struct sb_prepared *prepared)
{
    struct sb_arena arena = {0};
    const char *vertex, *fragment;
    (void)prepared;
    if (!is_anchor(job->id))
        return;
    ++*(int *)user;
    read_repository("gl/shade.vert", &arena, &vertex);
    read_repository("gl/shade.frag", &arena, &fragment);
    assert_int_equal(job->program_count, 1);
    assert_string_equal(job->program->role, "shade");
    assert_string_equal(job->program->vertex, vertex);
    assert_string_equal(job->program->fragment, fragment);
    assert_string_equal(job->scene, "containers");
    assert_int_equal(job->lit_count, 0);
    sb_arena_free(&arena);
}

static void the_frozen_texts_are_what_is_drawn(void **state)
{
    (void)state;
    int checked = 0;
    next_script.prepare = check_texts;
    next_script.user = &checked;
    measure(1);
    assert_int_equal(checked, 1); // one program, which all variants are held against
}

static void the_anchor_needs_no_shader_folder(void **state)
{
    (void)state;
    if (!measure_from("/tmp", 1)) // no shaders lie there
        fail_msg("%s", err.text);
    for (int i = 0; i < measured.row_count; i++) {
        assert_string_equal(measured.row[i].status, "bad_input");
        assert_non_null(measured.row[i].anchor);
        assert_null(measured.row[i].source_hash);
        assert_true(isnan(measured.row[i].ratio));
    }
    assert_int_equal(measured.exit_code, 2);
}

static void fail_anchor(void *user, const struct sb_job *job,
                        struct sb_prepared *prepared)
{
    (void)user;
    if (is_anchor(job->id))
        sb_fail(&prepared->error, SB_COMPILE_FAILED, "u_model is no more");
}

static void an_anchor_that_does_not_draw_ends_it(void **state)
{
    (void)state;
    next_script.prepare = fail_anchor;
    assert_false(measure_from(NULL, 1));
    assert_int_equal(err.status, SB_COMPILE_FAILED);
    check_contains(err.text, "the anchor: u_model is no more");
    assert_int_equal(measured.row_count, 0);
}

// --- ratios ------------------------------------------------------------------------------------

static void a_ratio_is_that_of_frames_whatever_the_batches(void **state)
{
    (void)state;
    measure(1);
    for (int i = 0; i < measured.row_count; i++) {
        const struct sb_history_row *row = &measured.row[i];
        check_close(row->ratio, 2.5, 1e-3);
        assert_true(row->ratio_lo <= row->ratio && row->ratio <= row->ratio_hi);
        assert_int_equal(row->pairs, PAIRS);
        assert_int_equal(row->processes, 1);
        assert_string_equal(row->status, "ok");
        assert_string_equal(row->variant, suite.entry[i].id);
        assert_string_equal(row->metric, "gpu");
        assert_null(row->threads); // no CPU draws, as far as is known
    }
    assert_int_equal(measured.exit_code, 0);
    assert_string_not_equal(measured.row[0].source_hash, measured.row[1].source_hash);
    // 2 ms a batch each: five frames of the anchor and two of a variant, in turns.
    const int last = 2 * PAIRS * suite.entry_count;
    int firsts = 0;
    for (int s = shots - last; s < shots; s += 2) {
        assert_true(is_anchor(shot[s].job) != is_anchor(shot[s + 1].job));
        firsts += is_anchor(shot[s].job);
        for (int k = 0; k < 2; k++)
            assert_int_equal(shot[s + k].frames, is_anchor(shot[s + k].job) ? 5 : 2);
    }
    assert_int_equal(firsts, last / 4);
}

static void processes_are_fresh_and_the_interval_is_theirs(void **state)
{
    (void)state;
    measure(3);
    assert_int_equal(opened, 3);
    for (int i = 0; i < measured.row_count; i++) {
        const struct sb_history_row *row = &measured.row[i];
        check_close(row->ratio, 2.5 * 1.1, 2e-3); // of 2.5, 2.75 and 3.025
        // Student's t with 2 degrees of freedom: 4.303 ln(1.1) / sqrt(3).
        check_close(log(row->ratio_hi / row->ratio), 4.30265 * log(1.1) / sqrt(3), 2e-3);
        check_close(log(row->ratio / row->ratio_lo), 4.30265 * log(1.1) / sqrt(3), 2e-3);
        assert_int_equal(row->processes, 3);
        assert_int_equal(row->pairs, 3 * PAIRS);
    }
}

// --- variants that fail ------------------------------------------------------------------------

static void fail_second(void *user, const struct sb_job *job,
                        struct sb_prepared *prepared)
{
    (void)user;
    if (job->id == 4)
        sb_fail(&prepared->error, SB_COMPILE_FAILED, "no");
}

static void a_variant_that_does_not_compile_has_a_row_without_a_ratio(void **state)
{
    (void)state;
    next_script.prepare = fail_second;
    measure(2);
    assert_string_equal(measured.row[1].status, "compile_failed");
    assert_true(isnan(measured.row[1].ratio));
    assert_int_equal(measured.row[1].pairs, 0);
    check_close(measured.row[0].ratio, 2.5 * sqrt(1.1), 2e-3);
    check_close(measured.row[2].ratio, 2.5 * sqrt(1.1), 2e-3);
    assert_int_equal(measured.exit_code, 3);
}

static float spoil_first(void *user, const struct sb_job *job,
                         const struct sb_image_request *request)
{
    (void)user;
    (void)request;
    return job->id == 2 ? NAN : 0.5f;
}

static void a_picture_that_is_not_finite_has_no_ratio(void **state)
{
    (void)state;
    next_script.colour = spoil_first;
    measure(1);
    assert_string_equal(measured.row[0].status, "non_finite");
    assert_true(isnan(measured.row[0].ratio));
    assert_string_equal(measured.row[1].status, "ok");
}

static unsigned lose_second(void *user, const struct sb_shot *asked, int64_t count)
{
    (void)user;
    return asked->job == 4 && count > 200 ? SB_SAMPLE_DISJOINT : 0;
}

static void a_variant_whose_samples_are_lost_on_the_way_says_so(void **state)
{
    (void)state;
    next_script.flags = lose_second;
    measure(1);
    assert_string_equal(measured.row[0].status, "ok");
    assert_int_equal(measured.row[0].pairs, PAIRS);
    assert_true(measured.row[1].pairs < PAIRS);
    assert_string_equal(measured.row[1].status, "samples_invalid");
}

static void threads_are_those_of_the_environment(void **state)
{
    (void)state;
    setenv("LP_NUM_THREADS", "3", 1);
    measure(1);
    assert_string_equal(measured.row[0].threads, "3");
}

// Six shots are its calibration, two warm up.
static unsigned lose_all_but_four(void *user, const struct sb_shot *asked, int64_t count)
{
    (void)user;
    (void)count;
    static int seen;
    seen += asked->job == 4;
    return asked->job == 4 && seen > 12 ? SB_SAMPLE_LOST : 0;
}

// Few pairs have a ratio, and no interval: the file takes that.
static void four_pairs_are_a_ratio_without_an_interval(void **state)
{
    (void)state;
    next_script.flags = lose_all_but_four;
    measure(1);
    assert_int_equal(measured.row[1].pairs, 4);
    assert_string_equal(measured.row[1].status, "ok");
    check_close(measured.row[1].ratio, 2.5, 1e-3);
    assert_true(isnan(measured.row[1].ratio_lo));
}

static unsigned interrupt_in_the_second(void *user, const struct sb_shot *asked,
                                        int64_t count)
{
    (void)user, (void)asked;
    if (opened == 2 && count == 100)
        raise(SIGINT);
    return 0;
}

// The last two of all, since a signal is not forgotten.
static void processes_that_were_done_before_a_signal_are_kept(void **state)
{
    (void)state;
    sb_interrupt_install();
    next_script.flags = interrupt_in_the_second;
    measure(3);
    assert_int_equal(measured.exit_code, 130);
    assert_int_equal(opened, 2);
    for (int i = 0; i < suite.entry_count; i++) {
        assert_int_equal(measured.row[i].processes, 1);
        assert_int_equal(measured.row[i].pairs, PAIRS);
        check_close(measured.row[i].ratio, 2.5, 1e-3);
    }
}

static void before_the_first_process_is_done_nothing_is_kept(void **state)
{
    (void)state;
    assert_true(sb_interrupted());
    assert_false(measure_from(NULL, 3));
    assert_int_equal(err.status, SB_INTERRUPTED);
    assert_int_equal(measured.row_count, 0);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, start, stop)
    const struct CMUnitTest tests[] = {
        TEST(the_files_of_the_anchor_are_what_they_always_were),
        TEST(an_anchor_of_another_scene_is_another_anchor),
        TEST(the_frozen_texts_are_what_is_drawn),
        TEST(the_anchor_needs_no_shader_folder),
        TEST(an_anchor_that_does_not_draw_ends_it),
        TEST(a_ratio_is_that_of_frames_whatever_the_batches),
        TEST(processes_are_fresh_and_the_interval_is_theirs),
        TEST(a_variant_that_does_not_compile_has_a_row_without_a_ratio),
        TEST(a_picture_that_is_not_finite_has_no_ratio),
        TEST(a_variant_whose_samples_are_lost_on_the_way_says_so),
        TEST(four_pairs_are_a_ratio_without_an_interval),
        TEST(threads_are_those_of_the_environment),
        TEST(processes_that_were_done_before_a_signal_are_kept),
        TEST(before_the_first_process_is_done_nothing_is_kept),
    };
#undef TEST
    return run_tests(tests);
}
