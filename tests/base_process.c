// Other programs, run to their end, and the environment that they get.
#include "test.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "base/environment.h"
#include "base/mem.h"
#include "base/process.h"

static struct sb_text text;
static struct sb_error err;

// A line for the shell; its exit code, or -1.
static int run(const char *line, enum sb_stream output, enum sb_stream errors)
{
    const char *const words[] = {"sh", "-c", line, NULL};
    int exit_code = -1;
    err = (struct sb_error){0};
    sb_text_clear(&text);
    sb_process_run(&(struct sb_process_params){words, .output = output, .errors = errors,
                                               .text = &text},
                   &exit_code, &err);
    return exit_code;
}

static void the_exit_code_and_what_it_said_come_back(void **state)
{
    (void)state;
    assert_int_equal(
        run("echo out; echo err >&2; exit 7", SB_STREAM_TAKEN, SB_STREAM_DROPPED), 7);
    assert_string_equal(sb_text_get(&text), "out\n");
    assert_int_equal(run("echo out; echo err >&2", SB_STREAM_DROPPED, SB_STREAM_TAKEN),
                     0);
    assert_string_equal(sb_text_get(&text), "err\n");
    assert_int_equal(run("echo lost", SB_STREAM_DROPPED, SB_STREAM_DROPPED), 0);
    assert_string_equal(sb_text_get(&text), "");
}

// More than a pipe holds, so it must be read while the program runs.
static void much_text_is_no_deadlock(void **state)
{
    (void)state;
    assert_int_equal(
        run("yes 0123456789 | head -n 50000", SB_STREAM_TAKEN, SB_STREAM_DROPPED), 0);
    assert_int_equal(text.length, 50000 * 11);
}

static void what_cannot_start_and_what_is_killed_have_a_reason(void **state)
{
    (void)state;
    const char *const nowhere[] = {"no-such-program-here", NULL};
    int exit_code = 5;
    assert_false(
        sb_process_run(&(struct sb_process_params){.words = nowhere}, &exit_code, &err));
    assert_int_equal(err.status, SB_USAGE);
    assert_string_equal(err.text, "no-such-program-here: No such file or directory");
    assert_int_equal(exit_code, 5);
    assert_int_equal(run("kill -KILL $$", SB_STREAM_KEPT, SB_STREAM_KEPT), -1);
    assert_int_equal(err.status, SB_WORKER_CRASHED);
    assert_string_equal(err.text, "sh was killed by signal 9");
}

// Its end is that of the program, not of what this one has open besides.
static void no_descriptor_of_the_pipe_is_left(void **state)
{
    (void)state;
    assert_int_equal(run("ls /proc/self/fd", SB_STREAM_TAKEN, SB_STREAM_DROPPED), 0);
    struct sb_text first = {0};
    sb_text_add(&first, sb_text_get(&text));
    assert_int_equal(run("ls /proc/self/fd", SB_STREAM_TAKEN, SB_STREAM_DROPPED), 0);
    assert_string_equal(sb_text_get(&text), sb_text_get(&first));
    sb_text_free(&first);
}

static void settings_go_over_the_environment_of_this_process(void **state)
{
    (void)state;
    static const char *const setting[] = {"SB_SET=1",   "SB_GONE",   "SB_SET=2",
                                          "SB_NEW=a=b", "SB_LAST=1", "SB_LAST"};
    static const char *const words[] = {
        "sh", "-c", "echo \"$SB_SET,${SB_GONE-none},$SB_NEW,${SB_LAST-none},$SB_KEPT\"",
        NULL};
    int exit_code = -1;
    setenv("SB_SET", "0", 1);
    setenv("SB_GONE", "0", 1);
    setenv("SB_KEPT", "k", 1);
    sb_text_clear(&text);
    assert_true(
        sb_process_run(&(struct sb_process_params){words, setting, 6, SB_STREAM_TAKEN,
                                                   SB_STREAM_KEPT, &text},
                       &exit_code, &err));
    assert_string_equal(sb_text_get(&text), "2,none,a=b,none,k\n");
    assert_string_equal(getenv("SB_SET"), "0"); // not ours
    assert_string_equal(getenv("SB_GONE"), "0");
    // Applied to this process they say the same.
    sb_environment_apply(setting, 6);
    assert_string_equal(getenv("SB_SET"), "2");
    assert_null(getenv("SB_GONE"));
    assert_string_equal(getenv("SB_NEW"), "a=b");
    assert_null(getenv("SB_LAST"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exit_code_and_what_it_said_come_back),
        cmocka_unit_test(much_text_is_no_deadlock),
        cmocka_unit_test(what_cannot_start_and_what_is_killed_have_a_reason),
        cmocka_unit_test(no_descriptor_of_the_pipe_is_left),
        cmocka_unit_test(settings_go_over_the_environment_of_this_process),
    };
    const int failed = run_tests(tests);
    sb_text_free(&text);
    return failed;
}
