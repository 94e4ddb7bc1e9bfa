// The conversation with a worker says what the runner says, and every way in which a worker can go
// wrong costs what it must and no more.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/log.h"
#include "base/text.h"
#include "job/null.h"
#include "test.h"
#include "wire/connection.h"
#include "wire/messages.h"
#include "wire/worker.h"

struct world {
    struct sb_context_params params;
    struct sb_caps caps;
    void *runner;
    struct sb_job job[3];
    char once[64];
    struct sb_text fault, marker;
    const char *environment[3];
};

static const struct sb_runner_fns *const fns = &sb_runner_worker;

static void describe(struct world *world, const char *fault, bool once)
{
    snprintf(world->once, sizeof world->once, "/tmp/sb-wire-%d", (int)getpid());
    unlink(world->once);
    sb_text_clear(&world->fault);
    sb_text_clear(&world->marker);
    sb_text_printf(&world->fault, "FAULT=%s", fault);
    sb_text_printf(&world->marker, "ONCE=%s", world->once);
    world->environment[0] = sb_text_get(&world->fault);
    world->environment[1] = sb_text_get(&world->marker);
    world->params = (struct sb_context_params){
        .context = "null",
        .device = -1,
        .environment = world->environment,
        .environment_count = once ? 2 : 1,
        .worker = SB_FAULTY_WORKER,
        .worker_limit_s = 0.5,
    };
}

static void start_described(struct world *world)
{
    struct sb_error err = {0};
    world->runner = fns->open(&world->params, &world->caps, &err);
    if (!world->runner)
        print_error("%s\n", err.text);
    assert_non_null(world->runner);
    static const struct sb_program program = {
        .role = "shade", .vertex = "void main() {}", .fragment = "// ü\n"};
    for (uint32_t i = 0; i < 3; i++) {
        world->job[i] = (struct sb_job){
            .id = i + 1, .scene = "room", .program = &program, .program_count = 1};
        sb_variant_init(sb_axes_builtin(), &world->job[i].variant);
    }
}

static void start(struct world *world, const char *fault, bool once)
{
    *world = (struct world){0};
    describe(world, fault, once);
    start_described(world);
}

static void prepare_all(struct world *world)
{
    struct sb_prepared prepared;
    for (int i = 0; i < 3; i++)
        assert_true(fns->prepare(world->runner, &world->job[i], &prepared));
}

static void end(struct world *world)
{
    fns->close(world->runner);
    unlink(world->once);
    sb_text_free(&world->fault);
    sb_text_free(&world->marker);
}

// Three shots, one of each job; the flags that came.
static void shoot(struct world *world, unsigned flags[3])
{
    struct sb_error err = {0};
    struct sb_sample sample[3] = {0};
    struct sb_shot shot[3];
    for (uint32_t i = 0; i < 3; i++)
        shot[i] = (struct sb_shot){.job = i + 1, .frames = 2, .shrink = 1};
    if (!fns->round(world->runner, shot, 3, sample, &err))
        print_error("%s\n", err.text);
    assert_int_equal(err.status == SB_OK || sample[0].flags || sample[1].flags, 1);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(sample[i].job, i + 1);
        flags[i] = sample[i].flags;
    }
}

static void check_flags(struct world *world, unsigned a, unsigned b, unsigned c)
{
    unsigned flags[3];
    shoot(world, flags);
    assert_int_equal(flags[0], a);
    assert_int_equal(flags[1], b);
    assert_int_equal(flags[2], c);
}

// --- the conversation ------------------------------------------------------------------------

static void a_worker_says_what_its_runner_says(void **state)
{
    (void)state;
    struct world world;
    struct sb_error err = {0};
    struct sb_caps caps;
    static struct sb_audit audit, direct_audit;
    struct sb_probe probe, direct_probe;
    start(&world, "none", false);
    void *direct = sb_runner_null.open(&world.params, &caps, &err);
    assert_memory_equal(&caps, &world.caps, sizeof caps);

    assert_true(fns->audit(world.runner, &audit, &err));
    assert_true(sb_runner_null.audit(direct, &direct_audit, &err));
    assert_int_equal(audit.reading_count, direct_audit.reading_count);
    assert_memory_equal(audit.reading, direct_audit.reading, sizeof audit.reading);
    assert_string_equal(audit.source[0].name, direct_audit.source[0].name);
    check_close(audit.source[0].empty_ns, direct_audit.source[0].empty_ns, 0);

    assert_true(fns->probe(world.runner, &probe, &err));
    assert_true(sb_runner_null.probe(direct, &direct_probe, &err));
    assert_int_equal(probe.count, direct_probe.count);
    assert_int_equal(probe.nesting, direct_probe.nesting);
    assert_true(isnan(probe.reading[0].lone) == isnan(direct_probe.reading[0].lone));
    check_close(probe.reading[3].round, direct_probe.reading[3].round, 0);

    struct sb_prepared prepared, direct_prepared;
    assert_true(fns->prepare(world.runner, &world.job[0], &prepared));
    assert_true(sb_runner_null.prepare(direct, &world.job[0], &direct_prepared));
    assert_int_equal(prepared.input_hash, direct_prepared.input_hash);
    assert_int_equal(prepared.fragments, direct_prepared.fragments);
    sb_runner_null.close(direct);
    end(&world);
}

static void pictures_and_rows_cross_bit_by_bit(void **state)
{
    (void)state;
    struct world world;
    struct sb_error err = {0};
    struct sb_image image = {0}, rows = {0};
    start(&world, "none", false);
    prepare_all(&world);
    const struct sb_image_request request = {
        .job = 2, .off_first = 3, .off_count = 1, .width = 5};
    assert_true(fns->image(world.runner, &request, &image, &err));
    assert_int_equal(image.width, 5);
    assert_int_equal(image.channels, 4);
    check_close(image.data[7], 0.5f + 0.001f * 3 + 0.1f, 0);
    sb_image_free(&image);
    sb_image_init(&rows, 2, 3, 4);
    rows.data[5] = NAN;
    const struct sb_image_request points = {
        .job = 2, .kind = SB_IMAGE_ROWS, .rows = &rows};
    assert_true(fns->image(world.runner, &points, &image, &err));
    assert_int_equal(image.width, 3);
    sb_image_free(&image);
    sb_image_free(&rows);
    end(&world);
}

static void what_a_driver_prints_stands_in_nobodys_way(void **state)
{
    (void)state;
    struct world world;
    start(&world, "print@round", false);
    prepare_all(&world);
    check_flags(&world, 0, 0, 0);
    end(&world);
}

static void a_released_job_is_gone(void **state)
{
    (void)state;
    struct world world;
    struct sb_error err = {0};
    struct sb_sample sample;
    start(&world, "none", false);
    prepare_all(&world);
    fns->release(world.runner, 2);
    const struct sb_shot shot = {.job = 2, .frames = 1, .shrink = 1};
    assert_false(fns->round(world.runner, &shot, 1, &sample, &err));
    check_contains(err.text, "job 2");
    end(&world);
}

// --- faults ----------------------------------------------------------------------------------

static const struct {
    const char *what;
    enum sb_status status;
    const char *text;
} faults[] = {
    {"segv", SB_WORKER_CRASHED, "was killed by SIGSEGV"},
    {"abort", SB_WORKER_CRASHED, "was killed by SIGABRT"},
    {"exit", SB_WORKER_CRASHED, "ended with exit code 7"},
    {"hang", SB_WORKER_HUNG, "did not answer within 0.5 s"},
    {"stop", SB_WORKER_HUNG, "did not answer within 0.5 s"},
    {"garbage", SB_WORKER_GARBAGE, "begins no message"},
    {"memory", SB_WORKER_CRASHED, "ended with exit code"}, // 3; 1 with a sanitizer
};
enum { FAULTS = sizeof faults / sizeof *faults };

static void a_fault_in_a_round_costs_that_round(void **state)
{
    (void)state;
    for (int i = 0; i < FAULTS; i++) {
        struct world world;
        struct sb_text fault = {0};
        sb_text_printf(&fault, "%s@round:2", faults[i].what);
        start(&world, sb_text_get(&fault), true);
        prepare_all(&world);
        check_flags(&world, SB_SAMPLE_LOST, SB_SAMPLE_LOST, SB_SAMPLE_LOST);
        assert_true(fns->holds(world.runner, 2, NULL));
        check_flags(&world, 0, 0, 0);
        assert_int_equal(fns->workers(world.runner), 2);
        end(&world);
        sb_text_free(&fault);
    }
}

static void a_job_that_takes_down_two_workers_is_given_up(void **state)
{
    (void)state;
    for (int i = 0; i < FAULTS; i++) {
        struct world world;
        struct sb_error why = {0};
        struct sb_text fault = {0};
        sb_text_printf(&fault, "%s@round:2", faults[i].what);
        start(&world, sb_text_get(&fault), false);
        prepare_all(&world);
        check_flags(&world, SB_SAMPLE_LOST, SB_SAMPLE_LOST, SB_SAMPLE_LOST);
        check_flags(&world, SB_SAMPLE_LOST, SB_SAMPLE_LOST, SB_SAMPLE_LOST);
        assert_false(fns->holds(world.runner, 2, &why));
        assert_int_equal(why.status, faults[i].status);
        check_contains(why.text, faults[i].text);
        check_flags(&world, 0, SB_SAMPLE_LOST, 0);
        assert_true(fns->holds(world.runner, 1, NULL));
        end(&world);
        sb_text_free(&fault);
    }
}

static void a_fault_in_prepare_is_tried_again_once(void **state)
{
    (void)state;
    struct world world;
    struct sb_prepared prepared;
    start(&world, "abort@prepare:2", true);
    prepare_all(&world);
    check_flags(&world, 0, 0, 0);
    end(&world);

    start(&world, "abort@prepare:2", false);
    assert_true(fns->prepare(world.runner, &world.job[0], &prepared));
    assert_false(fns->prepare(world.runner, &world.job[1], &prepared));
    assert_int_equal(prepared.error.status, SB_WORKER_CRASHED);
    check_contains(prepared.error.text, "SIGABRT");
    assert_true(fns->prepare(world.runner, &world.job[2], &prepared));
    assert_int_equal(fns->workers(world.runner), 3);
    end(&world);
}

static void a_fault_in_a_picture_is_tried_again_once(void **state)
{
    (void)state;
    struct world world;
    struct sb_error err = {0};
    struct sb_image image = {0};
    const struct sb_image_request request = {.job = 1};
    start(&world, "segv@image", true);
    prepare_all(&world);
    assert_true(fns->image(world.runner, &request, &image, &err));
    sb_image_free(&image);
    end(&world);

    start(&world, "segv@image", false);
    prepare_all(&world);
    assert_false(fns->image(world.runner, &request, &image, &err));
    assert_int_equal(err.status, SB_WORKER_CRASHED);
    end(&world);
}

// A fault that takes down the first worker; what the variable marks, each later one does.
static void start_marked(struct world *world, const char *variable)
{
    static struct sb_text marked;
    struct sb_error err = {0};
    *world = (struct world){0};
    describe(world, "exit@round:2", true);
    sb_text_clear(&marked);
    sb_text_printf(&marked, "%s=%s-mark", variable, world->once);
    unlink(strchr(marked.data, '=') + 1);
    world->environment[2] = marked.data;
    world->params.environment_count = 3;
    start_described(world);
    assert_true(fns->use_timer(world->runner, 0, &err));
    prepare_all(world);
    check_flags(world, SB_SAMPLE_LOST, SB_SAMPLE_LOST, SB_SAMPLE_LOST);
}

// None of what is asked afterwards may be drawn by the worker that was started in between.
static void check_refused(struct world *world, const char *why)
{
    for (int i = 0; i < 2; i++) {
        struct sb_error err = {0};
        struct sb_prepared prepared;
        struct sb_image image = {0};
        struct sb_sample sample[3];
        struct sb_job job = world->job[0];
        job.id = 10 + (uint32_t)i;
        assert_false(fns->prepare(world->runner, &job, &prepared));
        check_contains(prepared.error.text, why);
        const struct sb_image_request request = {.job = 1};
        assert_false(fns->image(world->runner, &request, &image, &err));
        check_contains(err.text, why);
        const struct sb_shot shot = {.job = 3, .frames = 1, .shrink = 1};
        err = (struct sb_error){0};
        assert_false(fns->round(world->runner, &shot, 1, sample, &err));
        check_contains(err.text, why);
        assert_int_equal(sample[0].flags, SB_SAMPLE_LOST);
    }
}

static void a_fresh_worker_with_another_driver_draws_nothing(void **state)
{
    (void)state;
    struct world world;
    start_marked(&world, "OTHER_DRIVER");
    check_refused(&world, "a fresh worker found another driver, another ");
    end(&world);
}

static void a_fresh_worker_without_the_timer_draws_nothing(void **state)
{
    (void)state;
    struct world world;
    start_marked(&world, "NO_TIMER");
    check_refused(&world, "there is no such timer");
    end(&world);
}

// The watch over the other end must not cut short an end that was asked for.
static void a_driver_that_is_slow_to_close_ends_in_good_order(void **state)
{
    (void)state;
    struct world world = {0};
    struct sb_connection line;
    struct sb_error err = {0};
    struct sb_text how = {0};
    describe(&world, "slow@close", false);
    assert_true(sb_connection_open(&line, &world.params, &err));
    struct sb_frame request = {.head = sb_wire_call("close")};
    assert_true(sb_connection_send(&line, "closing", &request, &err));
    sb_frame_free(&request);
    sb_child_end(&line.child, 10, &how);
    assert_string_equal(sb_text_get(&how), "ended with exit code 0");
    sb_connection_close(&line);
    sb_text_free(&how);
    sb_text_free(&world.fault);
    sb_text_free(&world.marker);
}

static void a_driver_that_dies_when_opened_is_told(void **state)
{
    (void)state;
    struct world world = {0};
    struct sb_error err = {0};
    describe(&world, "segv@open", false);
    assert_null(fns->open(&world.params, &world.caps, &err));
    assert_int_equal(err.status, SB_WORKER_CRASHED);
    check_contains(err.text, "opening the context: the worker was killed by SIGSEGV");
    sb_text_free(&world.fault);
    sb_text_free(&world.marker);
}

static void a_command_that_is_no_worker_is_told(void **state)
{
    (void)state;
    struct sb_caps caps;
    struct sb_context_params params = {.context = "null", .worker_limit_s = 2};
    struct sb_error err = {0};
    params.worker = "no-such-command-here 2>/dev/null";
    assert_null(fns->open(&params, &caps, &err));
    check_contains(err.text, "there is no such command");
    params.worker = "echo Welcome to this machine";
    assert_null(fns->open(&params, &caps, &err));
    assert_int_equal(err.status, SB_WORKER_GARBAGE);
    check_contains(err.text, "Welcome to this");
    signal(SIGPIPE, SIG_IGN); // as the program has it; a command has it as usual
    params.worker = "kill -PIPE $$; echo survived";
    assert_null(fns->open(&params, &caps, &err));
    signal(SIGPIPE, SIG_DFL);
    assert_int_equal(err.status, SB_WORKER_CRASHED);
    params.worker = "cat";
    assert_null(fns->open(&params, &caps, &err));
    assert_int_equal(err.status, SB_WORKER_GARBAGE);
}

static void instructions_come_where_they_were_asked_for(void **state)
{
    (void)state;
    struct world world = {0};
    struct sb_error err = {0};
    for (int count = 0; count < 2; count++) {
        struct sb_prepared prepared;
        struct sb_sample sample[2];
        const struct sb_shot shot[2] = {{.job = 1, .frames = 1, .shrink = 1},
                                        {.job = 1, .frames = 3, .shrink = 1}};
        start(&world, "none", false);
        fns->close(world.runner);
        world.params.count = count;
        world.runner = fns->open(&world.params, &world.caps, &err);
        assert_string_equal(world.caps.counter, count ? "made up" : "");
        assert_true(fns->prepare(world.runner, &world.job[0], &prepared));
        assert_true(fns->round(world.runner, shot, 2, sample, &err));
        if (count)
            assert_int_equal(3 * sample[0].instructions, sample[1].instructions);
        assert_int_equal(sample[0].instructions > 0, count);
        assert_int_equal(sample[0].instructions == SB_NO_TIME, !count);
        end(&world);
    }
}

static void a_worker_that_cannot_count_without_valgrind_says_so(void **state)
{
    (void)state;
    struct world world = {0};
    struct sb_error err = {0};
    char *path = strdup(getenv("PATH"));
    describe(&world, "none", false);
    world.params.count = world.params.callgrind = true;
    setenv("PATH", "/nowhere", 1);
    assert_null(fns->open(&world.params, &world.caps, &err));
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, "valgrind is missing");
    sb_text_free(&world.fault);
    sb_text_free(&world.marker);
}

static void the_environment_reaches_the_worker_and_nobody_else(void **state)
{
    (void)state;
    struct world world;
    start(&world, "none", false);
    assert_null(getenv("FAULT"));
    end(&world);
}

// A parent that is killed takes a worker that hangs with it.
static void a_worker_does_not_outlive_its_parent(void **state)
{
    (void)state;
    int lifeline[2];
    assert_int_equal(pipe(lifeline), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        struct world world;
        unsigned flags[3];
        start(&world, "hang@round", false);
        world.params.worker_limit_s = 60;
        prepare_all(&world);
        alarm(1); // SIGALRM ends this process in the midst of the round
        shoot(&world, flags);
        _exit(0);
    }
    close(lifeline[1]);
    int status;
    assert_int_equal(waitpid(parent, &status, 0), parent);
    // The worker has inherited the pipe: its end closes when the worker is gone.
    char byte;
    const int64_t begin = sb_clock_ns();
    assert_int_equal(read(lifeline[0], &byte, 1), 0);
    assert_true(sb_clock_ns() - begin < INT64_C(20000000000));
    close(lifeline[0]);
}

int main(void)
{
    sb_log_set_level(SB_LOG_QUIET);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_worker_says_what_its_runner_says),
        cmocka_unit_test(pictures_and_rows_cross_bit_by_bit),
        cmocka_unit_test(what_a_driver_prints_stands_in_nobodys_way),
        cmocka_unit_test(a_released_job_is_gone),
        cmocka_unit_test(a_fault_in_a_round_costs_that_round),
        cmocka_unit_test(a_job_that_takes_down_two_workers_is_given_up),
        cmocka_unit_test(a_fault_in_prepare_is_tried_again_once),
        cmocka_unit_test(a_fault_in_a_picture_is_tried_again_once),
        cmocka_unit_test(a_fresh_worker_with_another_driver_draws_nothing),
        cmocka_unit_test(a_fresh_worker_without_the_timer_draws_nothing),
        cmocka_unit_test(a_driver_that_is_slow_to_close_ends_in_good_order),
        cmocka_unit_test(a_driver_that_dies_when_opened_is_told),
        cmocka_unit_test(a_command_that_is_no_worker_is_told),
        cmocka_unit_test(instructions_come_where_they_were_asked_for),
        cmocka_unit_test(a_worker_that_cannot_count_without_valgrind_says_so),
        cmocka_unit_test(the_environment_reaches_the_worker_and_nobody_else),
        cmocka_unit_test(a_worker_does_not_outlive_its_parent),
    };
    return run_tests(tests);
}
