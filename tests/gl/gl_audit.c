#include "gl/audit.h"
#include "gl/timer.h"
#include "gl_test.h"
#include "test.h"

static struct gl_test test;
static struct sb_audit audit;

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Without the judge: the median of query/wall over batches of two frames and more.
static double agreement(int source)
{
    double ratio[SB_READING_MAX];
    int count = 0;
    for (int i = 0; i < audit.reading_count; i++) {
        const struct sb_timer_reading *r = &audit.reading[i];
        if (r->source == source && r->frames >= 2)
            ratio[count++] = (double)r->query_ns / (double)r->wall_ns;
    }
    assert_true(count > 0);
    qsort(ratio, (size_t)count, sizeof *ratio, compare_doubles);
    return ratio[count / 2];
}

static void a_credible_source_is_found_and_agrees_with_the_clock(void **state)
{
    (void)state;
    struct sb_error err = {0};
    audit.chosen = -1;
    // Other processes can spoil an audit, so a few are made; none must choose wrongly.
    for (int i = 0; i < 10 && audit.chosen < 0; i++) {
        if (!sb_gl_audit_read(&test.caps, &audit, &err))
            fail_msg("%s", err.text);
        sb_audit_judge(&audit, 0.05);
    }
    for (int i = 0; i < audit.source_count; i++)
        print_message("%s: %s\n", audit.source[i].name,
                      audit.source[i].credible ? "credible" : audit.source[i].reason);
    assert_true(audit.chosen >= 0);
    check_close(agreement(audit.chosen), 1, 0.05);
}

static void every_source_has_the_same_readings(void **state)
{
    (void)state;
    int count[SB_TIMER_MAX] = {0}, loads[SB_LOAD_COUNT] = {0}, longest = 0;
    assert_int_equal(audit.source_count, 4);
    for (int i = 0; i < audit.reading_count; i++) {
        const struct sb_timer_reading *r = &audit.reading[i];
        count[r->source]++;
        loads[r->load]++;
        longest = r->frames > longest ? r->frames : longest;
        assert_true(r->wall_ns > 0 && r->drained_ns > 0 && r->size > 0);
        assert_true((r->frames & (r->frames - 1)) == 0);
    }
    for (int i = 0; i < audit.source_count; i++) {
        assert_int_equal(audit.source[i].usable, sb_timers[i]->usable(&test.caps));
        assert_int_equal(count[i], audit.source[i].usable ? count[3] : 0);
    }
    assert_true(count[3] > 0 && longest >= 2);
    assert_true(loads[SB_LOAD_FRAGMENT] > 0 && loads[SB_LOAD_VERTEX] > 0);
}

static void the_clock_reads_no_query(void **state)
{
    (void)state;
    assert_string_equal(audit.source[3].name, "wall");
    assert_int_equal(audit.source[3].bits, 0);
    for (int i = 0; i < audit.reading_count; i++)
        if (audit.reading[i].source == 3)
            assert_true(audit.reading[i].query_ns == audit.reading[i].wall_ns);
}

static void samples_are_those_of_the_geometry(void **state)
{
    (void)state;
    for (int i = 0; i < audit.reading_count; i++) {
        const struct sb_timer_reading *r = &audit.reading[i];
        // The fragment load covers the target; the vertex load one pixel a triangle.
        const int64_t one = r->load == SB_LOAD_FRAGMENT ? r->size * r->size : 32 * 32;
        assert_int_equal(r->samples_one, test.caps.samples_passed ? one : -1);
        assert_int_equal(r->samples, test.caps.samples_passed ? r->frames * one : -1);
    }
}

static void granularity_and_empty_cost_are_small_times(void **state)
{
    (void)state;
    for (int i = 0; i < audit.source_count; i++) {
        const struct sb_timer_source *source = &audit.source[i];
        assert_int_equal(source->bits, sb_timers[i]->bits(&test.caps));
        if (!source->usable)
            continue;
        assert_true(source->granularity_ns >= 1 && source->granularity_ns < 1e6);
        assert_true(source->empty_ns >= 0 && source->empty_ns < 1e8);
    }
}

static int live_objects(void)
{
    int count = 0;
    for (GLuint name = 1; name < 256; name++)
        count += glIsQuery(name) + glIsProgram(name) + glIsShader(name) +
                 glIsVertexArray(name) + glIsFramebuffer(name) + glIsRenderbuffer(name);
    return count;
}

static void no_gl_object_and_no_error_is_left_behind(void **state)
{
    (void)state;
    assert_int_equal(live_objects(), 0);
    assert_null(sb_gl_error());
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_credible_source_is_found_and_agrees_with_the_clock),
        cmocka_unit_test(every_source_has_the_same_readings),
        cmocka_unit_test(the_clock_reads_no_query),
        cmocka_unit_test(samples_are_those_of_the_geometry),
        cmocka_unit_test(granularity_and_empty_cost_are_small_times),
        cmocka_unit_test(no_gl_object_and_no_error_is_left_behind),
    };
    gl_test_open(&test);
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
