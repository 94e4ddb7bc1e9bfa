#include "base/clock.h"
#include "gl/target.h"
#include "gl/timer.h"
#include "gl_test.h"
#include "test.h"

static struct gl_test test;

static const struct sb_timer_fns *find(const char *name)
{
    for (int i = 0; sb_timers[i]; i++)
        if (strcmp(sb_timers[i]->name, name) == 0)
            return sb_timers[i];
    fail_msg("no timer source %s", name);
    return NULL;
}

static void the_ladder_goes_from_the_plain_query_to_the_clock(void **state)
{
    (void)state;
    static const char *const ladder[] = {"elapsed", "elapsed+finish", "timestamp+finish",
                                         "wall"};
    for (int i = 0; i < 4; i++)
        assert_string_equal(sb_timers[i]->name, ladder[i]);
    assert_null(sb_timers[4]);
}

static void what_is_usable_follows_from_the_counter_bits_alone(void **state)
{
    (void)state;
    const struct sb_caps none = {0}, span = {.elapsed_bits = 30},
                         stamp = {.timestamp_bits = 36};
    for (int i = 0; sb_timers[i]; i++) {
        const char *name = sb_timers[i]->name;
        const bool wall = strcmp(name, "wall") == 0;
        const bool elapsed = strncmp(name, "elapsed", 7) == 0;
        assert_int_equal(sb_timers[i]->usable(&none), wall);
        assert_int_equal(sb_timers[i]->usable(&span), wall || elapsed);
        assert_int_equal(sb_timers[i]->usable(&stamp), !elapsed);
        assert_int_equal(sb_timers[i]->bits(&span), elapsed ? 30 : 0);
        assert_int_equal(sb_timers[i]->bits(&stamp), wall || elapsed ? 0 : 36);
    }
}

// Clears of a large target: a few milliseconds on a software renderer.
static int64_t time_clears(const struct sb_timer_fns *timer, struct sb_query *query,
                           int64_t *ns)
{
    const GLfloat black[4] = {0};
    const int64_t start = sb_clock_ns();
    timer->begin(query);
    for (int i = 0; i < 8; i++)
        glClearBufferfv(GL_COLOR, 0, black);
    timer->end(query);
    sb_gl_drain();
    const int64_t wall_ns = sb_clock_ns() - start;
    assert_int_equal(sb_timer_read(timer, query, &test.caps, ns), SB_READ_OK);
    return wall_ns;
}

static void every_usable_source_reads_a_time_within_its_wall_time(void **state)
{
    (void)state;
    const struct sb_target_params params = {512, 512, 1, SB_GL_RGBA8};
    struct sb_target target;
    assert_true(sb_target_make(&target, &test.caps, &params, NULL));
    for (int i = 0; sb_timers[i]; i++) {
        struct sb_query query;
        int64_t ns = -1;
        if (!sb_timers[i]->usable(&test.caps))
            continue;
        sb_query_make(&query);
        time_clears(sb_timers[i], &query, &ns); // the first may be absurd
        const int64_t wall_ns = time_clears(sb_timers[i], &query, &ns);
        if (sb_timers[i]->bits(&test.caps) == 0)
            assert_true(ns == SB_NO_TIME);
        else
            assert_true(ns >= 0 && ns <= wall_ns + wall_ns / 10);
        sb_query_free(&query);
        assert_int_equal(query.name[0], 0);
    }
    sb_target_free(&target);
    assert_null(sb_gl_error());
}

// --- readings that no driver here gives: glad's pointers are variables -----

static GLuint64 stamps[2];
static GLuint ready;
static GLint disjoint;

static void GLAD_API_PTR fake_ui64v(GLuint query, GLenum name, GLuint64 *value)
{
    (void)name;
    *value = stamps[query - 1];
}

static void GLAD_API_PTR fake_uiv(GLuint query, GLenum name, GLuint *value)
{
    (void)query, (void)name;
    *value = ready;
}

static void GLAD_API_PTR fake_integerv(GLenum name, GLint *value)
{
    assert_int_equal(name, GL_GPU_DISJOINT_EXT);
    *value = disjoint;
    disjoint = GL_FALSE; // reading clears it
}

static void scripted_readings_are_read_as_the_specification_says(void **state)
{
    (void)state;
    const PFNGLGETQUERYOBJECTUI64VPROC ui64v = glad_glGetQueryObjectui64v;
    const PFNGLGETQUERYOBJECTUIVPROC uiv = glad_glGetQueryObjectuiv;
    const PFNGLGETINTEGERVPROC integerv = glad_glGetIntegerv;
    glad_glGetQueryObjectui64v = fake_ui64v;
    glad_glGetQueryObjectuiv = fake_uiv;
    glad_glGetIntegerv = fake_integerv;
    const struct sb_timer_fns *timestamp = find("timestamp+finish");
    const struct sb_timer_fns *elapsed = find("elapsed");
    struct sb_caps caps = {.timestamp_bits = 36, .elapsed_bits = 64};
    struct sb_query query = {{1, 2}};
    int64_t ns = -7;

    ready = GL_FALSE;
    assert_int_equal(elapsed->read(&query, &caps, &ns), SB_READ_LATER);
    assert_int_equal(timestamp->read(&query, &caps, &ns), SB_READ_LATER);
    assert_int_equal(ns, -7);

    ready = GL_TRUE;
    stamps[0] = (UINT64_C(1) << 36) - 100; // the counter wraps inside the span
    stamps[1] = 50;
    assert_int_equal(timestamp->read(&query, &caps, &ns), SB_READ_OK);
    assert_int_equal(ns, 150);
    caps.timestamp_bits = 64;
    stamps[0] = UINT64_MAX - 9;
    stamps[1] = 20;
    assert_int_equal(timestamp->read(&query, &caps, &ns), SB_READ_OK);
    assert_int_equal(ns, 30);

    stamps[0] = UINT64_C(5000000000); // more than 32 bits
    assert_int_equal(elapsed->read(&query, &caps, &ns), SB_READ_OK);
    assert_int_equal(ns, INT64_C(5000000000));

    caps.disjoint = 1;
    disjoint = GL_TRUE;
    assert_int_equal(elapsed->read(&query, &caps, &ns), SB_READ_DISJOINT);
    assert_int_equal(elapsed->read(&query, &caps, &ns), SB_READ_OK);
    disjoint = GL_TRUE;
    assert_int_equal(timestamp->read(&query, &caps, &ns), SB_READ_DISJOINT);

    glad_glGetQueryObjectui64v = ui64v;
    glad_glGetQueryObjectuiv = uiv;
    glad_glGetIntegerv = integerv;
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ladder_goes_from_the_plain_query_to_the_clock),
        cmocka_unit_test(what_is_usable_follows_from_the_counter_bits_alone),
        cmocka_unit_test(every_usable_source_reads_a_time_within_its_wall_time),
        cmocka_unit_test(scripted_readings_are_read_as_the_specification_says),
    };
    gl_test_open(&test);
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
