// What callgrind's files say, and how the program is started that leaves them.
#include "test.h"

#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/text.h"
#include "job/callgrind.h"

// As callgrind 3.19 leaves it of a loop of 1000 rounds, a little shorter. The summary of what was
// counted from the middle of a function is 0 there.
static const char dump[] = "# callgrind format\n"
                           "version: 1\n"
                           "creator: callgrind-3.19.0\n"
                           "pid: 24684\n"
                           "cmd:  ./totals: 7\n"
                           "part: 1\n"
                           "\n"
                           "desc: Timerange: Basic block 0 - 1001\n"
                           "desc: Trigger: Client Request\n"
                           "\n"
                           "positions: line\n"
                           "events: Ir\n"
                           "summary: 0\n"
                           "\n"
                           "ob=(1) /tmp/t\n"
                           "fl=(1) ???\n"
                           "fn=(0) main\n"
                           "0 6003\n"
                           "\n"
                           "totals: 6003\n";

static void the_total_of_a_file_is_its_count(void **state)
{
    (void)state;
    int64_t count = -1;
    assert_true(sb_callgrind_total(dump, &count));
    assert_int_equal(count, 6003);
    assert_true(sb_callgrind_total("events: Ir Dr\ntotals: 123456789012345 4", &count));
    assert_int_equal(count, INT64_C(123456789012345));
}

static void a_file_that_is_cut_anywhere_is_none(void **state)
{
    (void)state;
    char part[sizeof dump];
    int64_t count = -1;
    const size_t end = (size_t)(strstr(dump, "totals: 6003") - dump) + strlen("totals: ");
    for (size_t length = 0; length <= end; length++) {
        memcpy(part, dump, length);
        part[length] = '\0';
        assert_false(sb_callgrind_total(part, &count));
    }
    // Within the number itself, too: the line must have its end.
    for (size_t length = end; length < sizeof dump - 2; length++) {
        memcpy(part, dump, length);
        part[length] = '\0';
        assert_false(sb_callgrind_total(part, &count));
    }
    assert_int_equal(count, -1);
}

static void a_file_of_other_events_is_none(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "events: Bc Ir\ntotals: 6003\n",
        "events: Irr\ntotals: 6003\n",
        "totals: 6003\n",
        "events: Ir\ntotals: many\n",
        "events: Ir\ntotals: -6\n",
        "events: Ir\ntotals: 99999999999999999999\n",
        "events: Ir\ntotals: 12x\n",
        "",
    };
    int64_t count = -1;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_false(sb_callgrind_total(wrong[i], &count));
    assert_int_equal(count, -1);
}

static void a_file_is_taken_once_and_only_from_its_process(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    int64_t count = -1;
    char *folder = sb_temporary_dir(&arena, "sb_job_callgrind", &err);
    assert_non_null(folder);
    static const char *const names[] = {"count.12", "count.123.1", "count.12.7"};
    for (int i = 0; i < 3; i++)
        assert_true(sb_file_replace(sb_path_join(&arena, folder, names[i]),
                                    i == 2 ? dump : "events: Ir\ntotals: 1\n",
                                    strlen(i == 2 ? dump : "events: Ir\ntotals: 1\n"),
                                    &err));
    assert_true(sb_callgrind_take(folder, 12, &count, &err));
    assert_int_equal(count, 6003);
    assert_false(sb_callgrind_take(folder, 12, &count, &err));
    assert_int_equal(err.status, SB_INTERNAL);
    check_contains(err.text, "count.12.");
    assert_true(sb_callgrind_take(folder, 123, &count, &err));
    assert_int_equal(count, 1);
    sb_dir_remove(folder);
    assert_false(sb_dir_exists(folder));
    sb_arena_free(&arena);
}

static void a_word_is_quoted_for_the_shell_whatever_is_in_it(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    static const char word[] = "it's \"$HOME\" `x` \\ *";
    char line[128], read[128] = "";
    snprintf(line, sizeof line, "printf %%s %s", sb_shell_quote(&arena, word));
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    assert_non_null(fgets(read, sizeof read, pipe));
    pclose(pipe);
    assert_string_equal(read, word);
    check_contains(sb_callgrind_command(&arena, "/a b"), "file='/a b/count.%p'");
    sb_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_total_of_a_file_is_its_count),
        cmocka_unit_test(a_file_that_is_cut_anywhere_is_none),
        cmocka_unit_test(a_file_of_other_events_is_none),
        cmocka_unit_test(a_file_is_taken_once_and_only_from_its_process),
        cmocka_unit_test(a_word_is_quoted_for_the_shell_whatever_is_in_it),
    };
    return run_tests(tests);
}
