// Instructions of a frame, counted under valgrind: the same frame has the same count, and one more
// light in a loop has more. Skipped where there is no valgrind.
#include <unistd.h>

#include "base/file.h"
#include "local_jobs.h"
#include "stats/counts.h"
#include "wire/worker.h"

enum { WARM = 4, REPEATS = SB_COUNTS_MOST };

static const struct sb_runner_fns *const worker = &sb_runner_worker;

// Diffuse light of `lights` lights, the last of them again and again from POINTS on.
static void prepare_lights(struct text_job *it, uint32_t id, int lights)
{
    struct sb_prepared prepared;
    struct sb_text body = {0};
    char bound[32];
    add_lit(&body, AS_UNIFORMS);
    snprintf(bound, sizeof bound, "i < %d;", POINTS);
    char *at = strstr(body.data, bound);
    assert_non_null(at);
    at[4] = (char)('0' + lights);
    for (char *use = body.data; (use = strstr(use, "(i)"));)
        use[1] = 'j'; // within bounds, whatever i is
    char *brace = strchr(at, '{');
    *brace = '\0';
    char *text = NULL;
    struct sb_text whole = {0};
    sb_text_printf(&whole, "%s{ int j = min(i, %d);%s", body.data, POINTS - 1, brace + 1);
    text = whole.data;
    job_init(it, id, text);
    sb_text_free(&body);
    sb_text_free(&whole);
    if (!worker->prepare(runner, &it->job, &prepared))
        fail_msg("%s", prepared.error.text);
}

// Of a frame that the driver is used to: the first few of a context bind what is bound late.
static void count(uint32_t id, double counted[REPEATS])
{
    struct sb_error err = {0};
    struct sb_sample sample[WARM + REPEATS];
    struct sb_shot shot[WARM + REPEATS];
    for (int i = 0; i < WARM + REPEATS; i++)
        shot[i] = (struct sb_shot){.job = id, .frames = 1, .shrink = 1};
    if (!worker->round(runner, shot, WARM + REPEATS, sample, &err))
        fail_msg("%s", err.text);
    for (int i = 0; i < REPEATS; i++) {
        counted[i] = (double)sample[WARM + i].instructions;
        print_message("job %u: %.0f\n", (unsigned)id, counted[i]);
    }
}

// By those that agree, as the gate does: once in many frames a driver does more.
static struct sb_counts_reading compare(const double *base, const double *head)
{
    double scratch[REPEATS];
    return sb_counts_read(0.005, base, head, REPEATS, true, scratch);
}

static void the_same_frame_has_the_same_count(void **state)
{
    (void)state;
    struct text_job it[2];
    double counted[2][REPEATS];
    for (uint32_t i = 0; i < 2; i++)
        prepare_lights(&it[i], i + 1, POINTS);
    for (uint32_t i = 0; i < 2; i++)
        count(i + 1, counted[i]);
    // A thousandth is a fifth of what the gate tolerates; here they agree to a few instructions.
    const struct sb_counts_reading reading = compare(counted[0], counted[1]);
    assert_true(reading.repeatability <= 1e-3);
    check_close(reading.ratio.point, 1, 1e-3);
    // The frame itself was counted: its pixels cannot do with an eighth of an instruction each.
    assert_true(reading.base > (double)SIZE * SIZE / 8);
    for (uint32_t i = 0; i < 2; i++) {
        worker->release(runner, i + 1);
        job_free(&it[i]);
    }
}

static void one_more_light_costs_more(void **state)
{
    (void)state;
    struct text_job it[3];
    double counted[3][REPEATS];
    for (uint32_t i = 0; i < 3; i++)
        prepare_lights(&it[i], i + 1, POINTS + (int)i);
    for (uint32_t i = 0; i < 3; i++) {
        count(i + 1, counted[i]);
        worker->release(runner, i + 1);
        job_free(&it[i]);
    }
    for (int i = 1; i < 3; i++) {
        const struct sb_counts_reading reading = compare(counted[i - 1], counted[i]);
        assert_true(reading.ratio.lo > 1 + 5 * reading.repeatability);
        assert_true(reading.ratio.lo > 1.001);
    }
}

static void a_worker_that_is_not_asked_counts_nothing(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_caps plain;
    struct sb_sample sample;
    struct sb_prepared prepared;
    struct sb_error err = {0};
    const struct sb_shot shot = {.job = 1, .frames = 1, .shrink = 1};
    const struct sb_context_params params = {.context = gl_test_context(),
                                             .gles = gl_test_gles(),
                                             .device = -1,
                                             .worker = SB_PROGRAM "-worker"};
    void *other = worker->open(&params, &plain, &err);
    assert_non_null(other);
    assert_string_equal(plain.counter, "");
    assert_string_equal(plain.renderer, caps.renderer);
    job_init(&it, 1, flat);
    assert_true(worker->prepare(other, &it.job, &prepared));
    assert_true(worker->round(other, &shot, 1, &sample, &err));
    assert_true(sample.instructions == SB_NO_TIME);
    worker->close(other);
    job_free(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_frame_has_the_same_count),
        cmocka_unit_test(one_more_light_costs_more),
        cmocka_unit_test(a_worker_that_is_not_asked_counts_nothing),
    };
    static const char *const environment[] = {"LP_NUM_THREADS=0",
                                              "MESA_SHADER_CACHE_DISABLE=true"};
    const struct sb_context_params params = {
        .context = gl_test_context(),
        .gles = gl_test_gles(),
        .device = -1,
        .worker = SB_PROGRAM "-worker",
        .worker_limit_s = 280,
        .count = true,
        .callgrind = true,
        .environment = environment,
        .environment_count = 2,
    };
    struct sb_error err = {0};
#ifdef __SANITIZE_ADDRESS__
    fprintf(stderr, "skipped: valgrind runs no program with AddressSanitizer\n");
    return 77;
#endif
    if (!sb_in_path("valgrind")) {
        fprintf(stderr, "skipped: there is no valgrind\n");
        return 77;
    }
    runner = worker->open(&params, &caps, &err);
    if (!runner)
        gl_test_unavailable(&err);
    if (!caps.counter[0]) {
        fprintf(stderr, "skipped: built without valgrind's headers\n");
        worker->close(runner);
        return 77;
    }
    assert_string_equal(caps.counter, "callgrind");
    const int failed =
        _cmocka_run_group_tests("count", tests, sizeof tests / sizeof *tests, NULL, NULL);
    worker->close(runner);
    return failed;
}
