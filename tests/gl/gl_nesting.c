#include "gl/audit.h"
#include "gl_test.h"
#include "test.h"

static struct gl_test test;

// No specification sets a limit; drivers whose answer is below 64 are what the probe is for,
// and none of those that the tests run on is one.
static void sixty_four_nested_conditionals_draw_right(void **state)
{
    (void)state;
    struct sb_error err = {0};
    int nesting = -1;
    assert_true(sb_gl_probe_nesting(&test.caps, &nesting, &err));
    assert_int_equal(nesting, SB_NESTING_ASKED);
}

static void the_probe_leaves_no_error_behind(void **state)
{
    (void)state;
    struct sb_error err = {0};
    int nesting;
    assert_true(sb_gl_probe_nesting(&test.caps, &nesting, &err));
    assert_null(sb_gl_error());
}

int main(void)
{
    gl_test_open(&test);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sixty_four_nested_conditionals_draw_right),
        cmocka_unit_test(the_probe_leaves_no_error_behind),
    };
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
