// Preparing and timing jobs, and what of it reaches the driver.
#include "local_jobs.h"

static void check_sample(const struct sb_sample *sample, const struct sb_shot *shot)
{
    assert_int_equal(sample->job, shot->job);
    assert_int_equal(sample->frames, shot->frames);
    assert_true(sample->submit_ns > 0);
    assert_true(sample->wall_ns >= sample->submit_ns);
    assert_true(sample->wall_ns < INT64_C(60000000000));
    assert_true(sample->cpu_ns >= 0);
    assert_int_equal(sample->flags & SB_SAMPLE_LOST, 0);
}

static void a_round_gives_one_sample_a_shot_in_order_by_every_timer(void **state)
{
    (void)state;
    static const struct sb_shot shots[] = {{2, 1, 1}, {1, 3, 1}, {1, 2, 2},
                                           {2, 4, 2}, {2, 1, 1}, {1, 1, 1}};
    enum { SHOTS = sizeof shots / sizeof *shots };
    struct text_job it[2];
    struct sb_prepared prepared;
    struct sb_sample samples[SHOTS];
    struct sb_error err = {0};
    for (uint32_t i = 0; i < 2; i++) {
        lit_init(&it[i], i + 1, false);
        prepare(&it[i], &prepared);
    }
    int source = 0, used = 0;
    for (; source < SB_TIMER_MAX; source++) {
        err = (struct sb_error){0};
        if (!fns->use_timer(runner, source, &err)) {
            assert_true(err.status == SB_NO_TIMER || err.status == SB_INTERNAL);
            continue;
        }
        used++;
        if (!fns->round(runner, shots, SHOTS, samples, &err))
            fail_msg("%s", err.text);
        for (int i = 0; i < SHOTS; i++)
            check_sample(&samples[i], &shots[i]);
    }
    // The last of the ladder is the wall clock: always there, and without a query.
    assert_true(used >= 1);
    assert_true(samples[0].gpu_ns == SB_NO_TIME);
    assert_int_equal(samples[0].flags, 0);
    for (uint32_t i = 0; i < 2; i++) {
        fns->release(runner, i + 1);
        job_free(&it[i]);
    }
}

static void a_round_with_an_unknown_job_or_a_senseless_shot_is_refused(void **state)
{
    (void)state;
    static const struct sb_shot wrong[] = {{9, 1, 1}, {1, 0, 1}, {1, 1, 3}, {1, 1, 0}};
    struct text_job it;
    struct sb_prepared prepared;
    job_init(&it, 1, flat);
    prepare(&it, &prepared);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct sb_error err = {0};
        struct sb_sample sample;
        assert_false(fns->round(runner, &wrong[i], 1, &sample, &err));
        assert_int_equal(err.status, SB_INTERNAL);
    }
    fns->release(runner, 1);
    job_free(&it);
}

static void preparing_measures_every_step(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    job_init(&it, 1, flat);
    prepare(&it, &prepared);
    assert_int_equal(prepared.error.status, SB_OK);
    assert_null(prepared.log);
    assert_true(prepared.compile_ms > 0);
    assert_true(prepared.link_ms > 0);
    assert_true(prepared.first_draw_ms > 0);
    assert_true(prepared.gl_calls > 0);
    assert_true(caps.program_binary == 0 || prepared.binary_hash != 0);
    fns->release(runner, 1);
    job_free(&it);
}

static struct {
    GLuint framebuffer;
    int width, height;
} frames_seen[16];
static int frames_seen_count;
static PFNGLVIEWPORTPROC real_viewport;

// Every frame sets the viewport once, after it bound its target.
static void GLAD_API_PTR see_frame(GLint x, GLint y, GLsizei width, GLsizei height)
{
    GLint framebuffer;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    if (frames_seen_count < 16) {
        frames_seen[frames_seen_count].framebuffer = (GLuint)framebuffer;
        frames_seen[frames_seen_count].width = width;
        frames_seen[frames_seen_count].height = height;
    }
    frames_seen_count++;
    real_viewport(x, y, width, height);
}

static void a_batch_is_whole_frames_that_alternate_between_two_targets(void **state)
{
    (void)state;
    static const struct sb_shot shots[] = {{1, 3, 1}, {1, 4, 2}};
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_sample samples[2];
    struct sb_error err = {0};
    job_init(&it, 1, flat);
    sb_variant_put(&it.job.variant, SB_AXIS_HEIGHT, SIZE - 1);
    prepare(&it, &prepared);
    real_viewport = glad_glViewport;
    glad_glViewport = see_frame;
    frames_seen_count = 0;
    assert_true(fns->round(runner, shots, 2, samples, &err));
    glad_glViewport = real_viewport;
    assert_int_equal(frames_seen_count, 3 + 4);
    for (int i = 0; i < 7; i++) {
        assert_int_equal(frames_seen[i].width, i < 3 ? SIZE : SIZE / 2);
        assert_int_equal(frames_seen[i].height, i < 3 ? SIZE - 1 : SIZE / 2);
    }
    for (int i = 1; i < 7; i++)
        assert_int_not_equal(frames_seen[i].framebuffer, frames_seen[i - 1].framebuffer);
    assert_int_equal(frames_seen[2].framebuffer, frames_seen[0].framebuffer);
    assert_int_equal(frames_seen[6].framebuffer, frames_seen[4].framebuffer);
    fns->release(runner, 1);
    job_free(&it);
}

static GLuint64 scripted_ns;

static void GLAD_API_PTR read_scripted(GLuint query, GLenum name, GLuint64 *value)
{
    (void)query, (void)name;
    *value = scripted_ns;
}

static void GLAD_API_PTR never_available(GLuint query, GLenum name, GLuint *value)
{
    (void)query, (void)name;
    *value = GL_FALSE;
}

// Source 0 is the plain GL_TIME_ELAPSED.
static void readings_that_cannot_be_are_flagged(void **state)
{
    (void)state;
    static const struct sb_shot shot = {1, 1, 1};
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_sample sample;
    struct sb_error err = {0};
    if (!fns->use_timer(runner, 0, &err))
        skip();
    job_init(&it, 1, flat);
    prepare(&it, &prepared);

    const PFNGLGETQUERYOBJECTUI64VPROC real_value = glad_glGetQueryObjectui64v;
    glad_glGetQueryObjectui64v = read_scripted;
    static const struct {
        GLuint64 ns;
        unsigned flags;
    } cases[] = {
        {1000, 0},
        {0, 0},
        {UINT64_C(1000000000), 0}, // short batches on coarse clocks
        {UINT64_C(60000000000), SB_SAMPLE_ABSURD},
        {UINT64_MAX, SB_SAMPLE_ABSURD}, // negative as int64_t
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scripted_ns = cases[i].ns;
        assert_true(fns->round(runner, &shot, 1, &sample, &err));
        assert_int_equal(sample.gpu_ns, (int64_t)cases[i].ns);
        assert_int_equal(sample.flags, cases[i].flags);
    }
    glad_glGetQueryObjectui64v = real_value;

    const PFNGLGETQUERYOBJECTUIVPROC real_state = glad_glGetQueryObjectuiv;
    glad_glGetQueryObjectuiv = never_available;
    assert_true(fns->round(runner, &shot, 1, &sample, &err));
    glad_glGetQueryObjectuiv = real_state;
    assert_int_equal(sample.flags, SB_SAMPLE_LOST);
    assert_true(sample.gpu_ns == SB_NO_TIME);
    assert_true(sample.wall_ns > 0 &&
                sample.wall_ns < 900000000); // the wait is not in it
    fns->release(runner, 1);
    job_free(&it);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_round_gives_one_sample_a_shot_in_order_by_every_timer),
        cmocka_unit_test(a_round_with_an_unknown_job_or_a_senseless_shot_is_refused),
        cmocka_unit_test(preparing_measures_every_step),
        cmocka_unit_test(a_batch_is_whole_frames_that_alternate_between_two_targets),
        cmocka_unit_test(readings_that_cannot_be_are_flagged),
    };
    return run_with_runner(tests, sizeof tests / sizeof *tests);
}
