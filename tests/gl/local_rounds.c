// Preparing and timing jobs, and what of it reaches the driver.
#include "base/clock.h"
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
    static const struct sb_shot shots[] = {
        {2, 1, 1, SB_PART_WHOLE}, {1, 3, 1, SB_PART_WHOLE}, {1, 2, 2, SB_PART_WHOLE},
        {2, 4, 2, SB_PART_WHOLE}, {2, 1, 1, SB_PART_WHOLE}, {1, 1, 1, SB_PART_WHOLE}};
    enum { SHOTS = sizeof shots / sizeof *shots };
    struct text_job it[2];
    struct sb_prepared prepared;
    struct sb_sample samples[SHOTS];
    struct sb_error err = {0};
    for (uint32_t i = 0; i < 2; i++) {
        lit_init(&it[i], i + 1, AS_UNIFORMS);
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
    static const struct sb_shot wrong[] = {{1, 1, 1, SB_PART_SHADOWS},
                                           {9, 1, 1, SB_PART_WHOLE},
                                           {1, 0, 1, SB_PART_WHOLE},
                                           {1, 1, 3, SB_PART_WHOLE},
                                           {1, 1, 0, SB_PART_WHOLE}};
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

static void what_preparing_costs_is_summed_over_the_programs(void **state)
{
    (void)state;
    struct text_job one, two, other;
    struct sb_prepared prepared[3];
    job_init(&one, 1, flat);
    job_init(&two, 2, flat);
    job_init(&other, 3, flat);
    job_add_lamp(&two, lamp);
    job_add_lamp(&other, flat);
    prepare(&one, &prepared[0]);
    prepare(&two, &prepared[1]);
    prepare(&other, &prepared[2]);
    // The same shading program, but other lamps: other code.
    const bool hashed = caps.program_binary > 0;
    for (int i = 0; i < 3; i++)
        assert_int_equal(prepared[i].binary_hash != 0, hashed);
    assert_int_equal(prepared[1].binary_hash != prepared[2].binary_hash, hashed);
    assert_int_equal(prepared[0].binary_hash != prepared[1].binary_hash, hashed);
    // Each lamp is drawn, in each frame.
    assert_true(prepared[1].gl_calls > prepared[0].gl_calls + 3 * POINTS);
    assert_true(prepared[1].vertices > prepared[0].vertices);
    for (uint32_t id = 1; id <= 3; id++)
        fns->release(runner, id);
    job_free(&one);
    job_free(&two);
    job_free(&other);
}

static int compiles_seen;
static PFNGLCOMPILESHADERPROC real_compile;
static PFNGLLINKPROGRAMPROC real_link;

// So that the sums can be told from the times of one program.
static void wait_ms(long ms)
{
    const int64_t end = sb_clock_ns() + ms * 1000000;
    while (sb_clock_ns() < end)
        ;
}

static void GLAD_API_PTR slow_compile(GLuint shader)
{
    compiles_seen++;
    wait_ms(20);
    real_compile(shader);
}

static void GLAD_API_PTR slow_link(GLuint program)
{
    wait_ms(30);
    real_link(program);
}

static void compile_and_link_times_are_those_of_all_programs(void **state)
{
    (void)state;
    struct text_job it;
    struct sb_prepared prepared;
    job_init(&it, 1, flat);
    job_add_lamp(&it, lamp);
    real_compile = glad_glCompileShader;
    real_link = glad_glLinkProgram;
    glad_glCompileShader = slow_compile;
    glad_glLinkProgram = slow_link;
    const bool ok = fns->prepare(runner, &it.job, &prepared);
    glad_glCompileShader = real_compile;
    glad_glLinkProgram = real_link;
    assert_true(ok);
    assert_int_equal(compiles_seen, 4);
    assert_true(prepared.compile_ms >= 80);
    assert_true(prepared.link_ms >= 60);
    fns->release(runner, 1);
    job_free(&it);
}

// The uploads of a batch, by the first float of each: positions of the first point light.
static float uploads_seen[32];
static int upload_count;
static PFNGLUNIFORM3FVPROC real_uniform3;

static void GLAD_API_PTR see_position(GLint location, GLsizei count, const GLfloat *value)
{
    if (count == POINTS && upload_count < 32)
        uploads_seen[upload_count++] = value[0];
    real_uniform3(location, count, value);
}

static void each_frame_of_a_batch_uploads_the_next_phase(void **state)
{
    (void)state;
    static const struct sb_shot shot = {1, SB_PHASES + 2, 1, SB_PART_WHOLE};
    struct text_job it;
    struct sb_prepared prepared;
    struct sb_sample sample;
    struct sb_scene scene = {0};
    struct sb_error err = {0};
    lit_init(&it, 1, AS_ARRAYS); // position, ambient, diffuse: three calls an upload
    sb_variant_put(&it.job.variant, SB_AXIS_UPDATE, SB_UPDATE_LIGHTS);
    prepare(&it, &prepared);
    real_uniform3 = glad_glUniform3fv;
    glad_glUniform3fv = see_position;
    upload_count = 0;
    assert_true(fns->round(runner, &shot, 1, &sample, &err));
    glad_glUniform3fv = real_uniform3;
    assert_int_equal(upload_count, 3 * shot.frames);

    assert_true(sb_scene_make("sphere", &it.job.variant, &scene, &err));
    for (int i = 0; i < shot.frames; i++) {
        const struct sb_phase phase = {i % SB_PHASES, 0, 1};
        struct sb_light moved[POINTS];
        sb_lights_phase(&scene.lights, &phase, moved);
        assert_true(uploads_seen[3 * i] == moved[0].position[0]);
    }
    sb_scene_free(&scene);
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
    static const struct sb_shot shots[] = {{1, 3, 1, SB_PART_WHOLE},
                                           {1, 4, 2, SB_PART_WHOLE}};
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
    static const struct sb_shot shot = {1, 1, 1, SB_PART_WHOLE};
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
        cmocka_unit_test(what_preparing_costs_is_summed_over_the_programs),
        cmocka_unit_test(compile_and_link_times_are_those_of_all_programs),
        cmocka_unit_test(each_frame_of_a_batch_uploads_the_next_phase),
        cmocka_unit_test(a_batch_is_whole_frames_that_alternate_between_two_targets),
        cmocka_unit_test(readings_that_cannot_be_are_flagged),
    };
    return run_with_runner(tests, sizeof tests / sizeof *tests);
}
