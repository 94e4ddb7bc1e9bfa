// The gate by instructions, on the null runner: which counts become which verdict, what is asked of
// the processes, and where the metric is refused.
#include "test.h"

#include <unistd.h>

#include "base/file.h"
#include "base/log.h"
#include "gate/gate.h"
#include "job/null.h"
#include "results/csv.h"
#include "stats/counts.h"

static struct {
    double ratio;       // of head's counts to base's …
    double fresh_ratio; // … and in the process that confirms
    int64_t apart;      // the count of this number stands apart; 0: none does
    bool noisy, hardware;
    int opened, counted; // runners; those that were asked to count
    char environment[256];
} script;

static int64_t count(void *user, const struct sb_job *job, const struct sb_shot *shot,
                     int64_t number)
{
    (void)user;
    const bool head = job->id % SB_SIDES == 0;
    double value = 1e6 * shot->frames;
    if (head)
        value *= script.opened > 2 ? script.fresh_ratio : script.ratio;
    if (script.noisy)
        value *= 1 + 0.01 * (double)(number % 7);
    if (script.apart && number == script.apart)
        value *= 1.33;
    return (int64_t)(value + 0.5);
}

static void *open_scripted(const struct sb_context_params *params, struct sb_caps *caps,
                           struct sb_error *err)
{
    void *runner = sb_runner_null.open(params, caps, err);
    struct sb_text text = {0};
    script.opened++;
    script.counted += params->count;
    for (int i = 0; i < params->environment_count; i++)
        sb_text_printf(&text, "%s ", params->environment[i]);
    snprintf(script.environment, sizeof script.environment, "%s", sb_text_get(&text));
    sb_text_free(&text);
    if (script.hardware)
        caps->software = 0;
    *sb_null_script(runner) = (struct sb_null_script){.instructions = count};
    return runner;
}

static const char folder[] = "/tmp/sb-gate-counts";
static struct sb_gate_result result;
static struct sb_error err;

// A plan of one light and of two, both sides from one folder.
static bool run(bool selftest)
{
    static struct sb_suite suite[SB_SIDES];
    static struct sb_runner_fns fns;
    const struct sb_assignment sweep = {"point", "1,2", "--sweep"};
    const struct sb_suite_params plan = {.sweep = &sweep, .sweep_count = 1};
    static json_t *arguments;
    fns = sb_runner_null;
    fns.open = open_scripted;
    err = (struct sb_error){0};
    result = (struct sb_gate_result){0};
    sb_dir_remove(folder); // of a run that failed
    script.opened = script.counted = 0;
    arguments = json_array();
    struct sb_gate_params params = {
        .keep_equal = true,
        .selftest = selftest,
        .rule = sb_gate_rule_default(1),
        .metric = SB_METRIC_INSTRUCTIONS,
        .data_dir = SB_SOURCE_DIR,
        .dir = folder,
        .arguments = arguments,
    };
    params.rule.tolerance = sb_metric_rows[SB_METRIC_INSTRUCTIONS].tolerance;
    for (int side = 0; side < SB_SIDES; side++) {
        assert_true(sb_suite_load(&plan, &suite[side], &err));
        params.side[side] = (struct sb_gate_side_params){
            .suite = &suite[side],
            .driver = {.runner = &fns, .context = {.context = "null", .device = -1}},
        };
    }
    params.settings = &suite[SB_HEAD].measure;
    const bool good = sb_gate_run(&params, &result, &err);
    json_decref(arguments);
    return good;
}

static void end(void)
{
    sb_gate_result_free(&result);
    sb_dir_remove(folder);
}

static void check_verdicts(enum sb_gate_verdict verdict, int exit_code)
{
    if (!run(false))
        fail_msg("%s", err.text);
    for (int i = 0; i < 2; i++)
        assert_string_equal(result.row[i].verdict, sb_gate_verdict_rows[verdict].word);
    assert_int_equal(result.exit_code, exit_code);
}

static void counts_are_judged_and_candidates_counted_again(void **state)
{
    (void)state;
    static const struct {
        double ratio, fresh_ratio;
        enum sb_gate_verdict verdict;
        int exit_code, opened;
    } rows[] = {
        {1, 1, SB_GATE_PASS, 0, 2},
        {1.004, 9, SB_GATE_PASS, 0, 2},
        {0.98, 9, SB_GATE_IMPROVED, 0, 2},
        {1.01, 1.01, SB_GATE_REGRESSION, 1, 3},
        {1.01, 1.004, SB_GATE_NOT_CONFIRMED, 0, 3},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        script.ratio = rows[i].ratio;
        script.fresh_ratio = rows[i].fresh_ratio;
        check_verdicts(rows[i].verdict, rows[i].exit_code);
        assert_int_equal(script.opened, rows[i].opened);
        assert_int_equal(script.counted, rows[i].opened);
        const struct sb_gate_row *row = &result.row[0];
        check_close(row->ratio, rows[i].ratio, 1e-6);
        check_close(row->base_instructions, 1e6, 0);
        check_close(row->repeatability, 0, 0);
        assert_int_equal(row->pairs, SB_COUNTS_REPEATS);
        assert_true(isnan(row->base_ms) && isnan(row->p_slower));
        if (rows[i].opened == 3)
            check_close(row->confirm_ratio, rows[i].fresh_ratio, 1e-6);
        else
            assert_true(isnan(row->confirm_ratio));
        end();
    }
}

static void counts_that_do_not_repeat_are_inconclusive_and_say_so(void **state)
{
    (void)state;
    script.ratio = 1.02;
    script.noisy = true;
    check_verdicts(SB_GATE_INCONCLUSIVE, 0);
    assert_int_equal(result.row[0].pairs, SB_COUNTS_MOST);
    check_contains(result.row[0].note, "counts of one frame differ");
    assert_true(result.counting.repeatability > 0.005);
    script.noisy = false;
    end();
}

static void one_count_that_stands_apart_is_told_and_decides_nothing(void **state)
{
    (void)state;
    script.ratio = 1;
    // Shots are numbered from 0; four of them warm up, and the next are the first variant's.
    script.apart = 6;
    check_verdicts(SB_GATE_PASS, 0);
    assert_int_equal(result.row[0].pairs + result.row[1].pairs,
                     2 * SB_COUNTS_REPEATS + 1);
    assert_int_equal(result.counting.apart, 1);
    check_close(result.counting.farthest, 0.33, 1e-6);
    assert_int_equal(result.counting.counts, 2 * (2 * SB_COUNTS_REPEATS + 1));
    end();
    // Nor does it where it is one of the frames that come before.
    script.apart = 2;
    check_verdicts(SB_GATE_PASS, 0);
    assert_int_equal(result.counting.apart, 0);
    script.apart = 0;
    end();
}

static void a_selftest_tells_the_bias_of_the_counts(void **state)
{
    (void)state;
    script.ratio = 1.001;
    assert_true(run(true));
    check_close(result.bias.bias, 0.001, 1e-6);
    assert_true(result.bias.tolerable);
    assert_int_equal(result.exit_code, 0);
    end();
    script.ratio = 1.003; // over half the tolerance
    assert_true(run(true));
    check_close(result.bias.ratio.lo, 1.003, 1e-6);
    assert_false(result.bias.tolerable);
    assert_int_equal(result.exit_code, sb_status_rows[SB_SAMPLES_INVALID].exit_code);
    end();
    script.ratio = 1.02; // no verdict, so nothing to confirm
    assert_true(run(true));
    assert_int_equal(script.opened, 2);
    assert_null(result.row[0].verdict);
    end();
}

static void the_processes_have_one_thread_and_no_cache(void **state)
{
    (void)state;
    script.ratio = 1;
    check_verdicts(SB_GATE_PASS, 0);
    check_contains(script.environment, "LP_NUM_THREADS=0");
    check_contains(script.environment, "MESA_SHADER_CACHE_DISABLE=true");
    end();
}

static void what_is_no_cpu_driver_is_refused(void **state)
{
    (void)state;
    script.hardware = true;
    assert_false(run(false));
    script.hardware = false;
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, "not known to draw on one");
    end();
}

// The rows and gate.json say what they are of.
static void the_files_say_what_the_counts_are_of(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    script.ratio = 1;
    check_verdicts(SB_GATE_PASS, 0);
    const char *pairs = sb_file_read(&arena, sb_path_join(&arena, folder, "pairs.csv"),
                                     1 << 20, NULL, &err);
    const char *json = sb_file_read(&arena, sb_path_join(&arena, folder, "gate.json"),
                                    1 << 20, NULL, &err);
    assert_non_null(pairs);
    assert_non_null(json);
    check_contains(pairs, ",1,instructions,1000000,1000000,");
    int rows = -1; // the head
    for (const char *line = pairs; (line = strchr(line, '\n')); line++)
        rows++;
    assert_int_equal(rows, 2 * SB_COUNTS_REPEATS);
    check_contains(json, "this CPU driver, not of any GPU");
    check_contains(json, "\"repeatability\": 0.0");
    check_contains(json, "\"tolerance\": 0.005");
    sb_arena_free(&arena);
    end();
}

static void code_that_differs_is_told_in_words(void **state)
{
    (void)state;
    struct sb_caps timed = {.cpu = "Big One", .renderer = "soft (256 bits)"};
    struct sb_caps counted = timed;
    char words[400];
    snprintf(timed.cpu_features, sizeof timed.cpu_features, "avx avx2 avx512f avx512vl");
    snprintf(counted.cpu_features, sizeof counted.cpu_features, "avx avx2");
    snprintf(counted.counter, sizeof counted.counter, "callgrind");
    sb_gate_other_code(&timed, &counted, words, sizeof words);
    assert_string_equal(words, "the code counted is not the code timed: callgrind hides "
                               "avx512f avx512vl");
    snprintf(counted.cpu, sizeof counted.cpu, "Small One");
    sb_gate_other_code(&timed, &counted, words, sizeof words);
    check_contains(words, "shows Small One for Big One");
    counted = timed;
    sb_gate_other_code(&timed, &counted, words, sizeof words);
    assert_string_equal(words, "");
    snprintf(counted.renderer, sizeof counted.renderer, "soft (128 bits)");
    sb_gate_other_code(&timed, &counted, words, sizeof words);
    check_contains(words, "soft (128 bits)");
}

int main(void)
{
    sb_log_set_level(SB_LOG_QUIET);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_are_judged_and_candidates_counted_again),
        cmocka_unit_test(counts_that_do_not_repeat_are_inconclusive_and_say_so),
        cmocka_unit_test(one_count_that_stands_apart_is_told_and_decides_nothing),
        cmocka_unit_test(a_selftest_tells_the_bias_of_the_counts),
        cmocka_unit_test(the_processes_have_one_thread_and_no_cache),
        cmocka_unit_test(what_is_no_cpu_driver_is_refused),
        cmocka_unit_test(the_files_say_what_the_counts_are_of),
        cmocka_unit_test(code_that_differs_is_told_in_words),
    };
    return run_tests(tests);
}
