// Where a context cannot be opened, one line says why, and the exit code is 77. And a
// second signal ends a run at once, even inside of the driver.
#include "cli_running.h"

#include "gl_test.h"

static struct running it;

static void check_unusable(const char *line, const char *part)
{
    static struct answer answer;
    run_shell(&answer, line);
    if (answer.code != 77 || !strstr(answer.text, part) || count_lines(answer.text) != 1)
        fail_msg("%s: exit code %d: %s", line, answer.code, answer.text);
}

static void without_gl_the_exit_code_is_77_and_one_line_says_why(void **state)
{
    (void)state;
    check_unusable("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent "
                   "exec $SB run --context egl -q -o @/none 2>&1",
                   "egl: ");
    check_unusable("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent "
                   "exec $SB probe --context egl 2>&1",
                   "egl: ");
    check_unusable("unset DISPLAY WAYLAND_DISPLAY; exec $SB probe --context glfw 2>&1",
                   "glfw: ");
    check_unusable("exec $SB probe --context osmesa --api gles 2>&1", "osmesa: ");
    check_unusable("exec $SB probe --context egl --device 63 2>&1", "device");
    // Nothing was measured, so nothing is in the way of the next try.
    check_answer("run --context null -q --rounds 20 --first-look 20 -o @/none", 0,
                 "results: ");
}

static void a_signal_in_the_audit_ends_the_run_and_a_second_one_at_once(void **state)
{
    (void)state;
    char line[256];
    snprintf(line, sizeof line, "run --context %s --api %s --set width=64 -o @/%%s",
             gl_test_context(), gl_test_gles() ? "gles" : "gl");
    char first[256], second[256];
    snprintf(first, sizeof first, line, "first");
    snprintf(second, sizeof second, line, "second");

    start_program(&it, first);
    wait_until_said(&it, "auditing");
    kill(it.pid, SIGTERM);
    assert_int_equal(finish(&it), 130);
    assert_false(run_is_complete("first/run.json"));
    check_contains(it.text, "interrupted; go on with");

    start_program(&it, second);
    wait_until_said(&it, "auditing");
    kill(it.pid, SIGINT);
    wait_until_handled(&it, SIGINT);
    kill(it.pid, SIGINT);
    assert_int_equal(finish(&it), 128 + SIGINT);
    assert_null(strstr(it.text, "interrupted"));
}

int main(void)
{
    struct gl_test test;
    gl_test_open(&test); // or the end, where there is no such context
    gl_test_close(&test);
    begin_tests();
    setenv("ASAN_OPTIONS", "handle_segv=2:detect_leaks=0", 1); // see cli_context.c
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_gl_the_exit_code_is_77_and_one_line_says_why),
        cmocka_unit_test(a_signal_in_the_audit_ends_the_run_and_a_second_one_at_once),
    };
    return end_tests(run_tests(tests));
}
