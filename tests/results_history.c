// The file of a history: it grows by whole rows, whatever happens to its writers.
#include "history_rows.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "results/history_file.h"
#include "results/history_time.h"

static char path[64];
static struct sb_error err;

static void write_text(const char *text)
{
    assert_true(sb_file_replace(path, text, strlen(text), &err));
}

static char *read_text(struct sb_arena *arena)
{
    char *text = sb_file_read(arena, path, (size_t)1 << 26, NULL, &err);
    assert_non_null(text);
    return text;
}

static void append(int count)
{
    if (!sb_history_append(path, history_row, count, &err))
        fail_msg("%s", err.text);
}

// A history of `count` commits, in memory and in the file.
static int start(void **state)
{
    (void)state;
    snprintf(path, sizeof path, "/tmp/shadebench-history-%d.csv", (int)getpid());
    unlink(path);
    history_count = 0;
    err = (struct sb_error){0};
    for (int i = 0; i < 3; i++)
        add_ratio(i, 1 + 0.01 * i);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    unlink(path);
    return 0;
}

static void check_read(int count)
{
    struct sb_history history = {0};
    if (!sb_history_read(path, &history, &err))
        fail_msg("%s", err.text);
    assert_int_equal(history.count, count);
    sb_history_free(&history);
}

static void check_unreadable(const char *part)
{
    struct sb_history history = {0};
    assert_false(sb_history_read(path, &history, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, part);
    sb_history_free(&history);
}

// --- times -------------------------------------------------------------------------------------

static void times_of_all_zones_become_utc(void **state)
{
    (void)state;
    static const char *const times[][2] = {
        {"2026-11-22", "2026-11-22T00:00:00Z"},
        {"2026-11-22T01:02:03Z", "2026-11-22T01:02:03Z"},
        {"2026-11-22T01:02:03+02:00", "2026-11-21T23:02:03Z"},
        {"2026-12-31T23:30:00-05:30", "2027-01-01T05:00:00Z"},
        {"2024-02-28T23:00:00-02:00", "2024-02-29T01:00:00Z"},
        {"2100-02-28T23:00:00-02:00", "2100-03-01T01:00:00Z"},
        {"2000-03-01T00:00:00+00:01", "2000-02-29T23:59:00Z"},
        {"1971-01-01T00:00:00Z", "1971-01-01T00:00:00Z"},
    };
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        char time[32];
        assert_true(sb_history_time(times[i][0], time, &err));
        assert_string_equal(time, times[i][1]);
        // date(1) knows calendars too.
        char command[160], said[32] = "";
        snprintf(command, sizeof command, "date -u -d '%s' +%%Y-%%m-%%dT%%H:%%M:%%SZ",
                 times[i][0]);
        FILE *pipe = popen(command, "r");
        assert_non_null(pipe);
        assert_non_null(fgets(said, sizeof said, pipe));
        pclose(pipe);
        said[strcspn(said, "\n")] = '\0';
        assert_string_equal(said, time);
    }
}

static void what_is_no_date_is_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {"",
                                        "2026",
                                        "22.11.2026",
                                        "2026-13-01",
                                        "2026-02-29",
                                        "2026-11-31",
                                        "2026-11-22T01:02:03",
                                        "2026-11-22T24:00:00Z",
                                        "now",
                                        "2026-11-22 01:02:03Z",
                                        "2026-11-22T01:02:03+2",
                                        "2026-11-22T01:02:03+02:00 ",
                                        "1969-12-31"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char time[32];
        if (sb_history_time(wrong[i], time, &err))
            fail_msg("\"%s\" was taken for %s", wrong[i], time);
        assert_int_equal(err.status, SB_USAGE);
    }
}

// --- appending ---------------------------------------------------------------------------------

static void rows_go_behind_one_header(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    append(0); // only looks
    append(1);
    append(3);
    const char *text = read_text(&arena);
    assert_int_equal(strncmp(text, "time,commit,suite,scene,", 24), 0);
    assert_null(strstr(text + 1, "time,commit"));
    sb_arena_free(&arena);

    struct sb_history history = {0};
    assert_true(sb_history_read(path, &history, &err));
    assert_int_equal(history.count, 4);
    assert_string_equal(history.row[0].commit, "c000");
    assert_string_equal(history.row[3].commit, "c002");
    assert_string_equal(history.row[3].variant, "point=4,stage=fragment");
    check_close(history.row[3].ratio, 1.02, 0);
    assert_int_equal(history.row[3].pairs, 60);
    sb_history_free(&history);
}

static void a_file_that_is_no_history_is_refused_and_stays_as_it_is(void **state)
{
    (void)state;
    static const char other[] = "time,commit,other\n1,2,3\n", half[] = "time,commits";
    struct sb_arena arena = {0};
    write_text(other);
    assert_false(sb_history_append(path, history_row, 1, &err));
    assert_int_equal(err.status, SB_BAD_INPUT);
    check_contains(err.text, ":1: is not the header of a history");
    assert_string_equal(read_text(&arena), other);
    check_unreadable(":1: is not the header");
    write_text(half);
    assert_false(sb_history_append(path, history_row, 1, &err));
    assert_string_equal(read_text(&arena), half);
    sb_arena_free(&arena);

    assert_false(sb_history_append("/tmp", history_row, 1, &err));
    check_contains(err.text, "/tmp: Is a directory");
    assert_false(sb_history_append("/nowhere/history.csv", history_row, 1, &err));
    check_contains(err.text, "name a file that can be written");
    if (access("/dev/full", W_OK) == 0) {
        assert_false(sb_history_append("/dev/full", history_row, 1, &err));
        check_contains(err.text, "is no regular file");
    }
}

static void of_a_writer_that_was_killed_no_half_row_stays(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    append(3);
    const char *whole = read_text(&arena);
    const size_t length = strlen(whole);
    const size_t header = strcspn(whole, "\n") + 1;
    for (size_t cut = 1; cut < length; cut += 7) {
        assert_int_equal(truncate(path, (off_t)cut), 0);
        int rows = -1;
        for (size_t i = 0; i < cut; i++)
            rows += whole[i] == '\n';
        if (rows >= 0)
            check_read(rows);
        else
            check_unreadable("empty");
        append(1); // the next writer
        check_read(rows < 0 ? 1 : rows + 1);
        // Behind the lines that were whole stands the first row again.
        const size_t row = strcspn(whole + header, "\n") + 1;
        const char *text = read_text(&arena);
        const size_t kept = strlen(text) - row;
        assert_memory_equal(text, whole, kept);
        assert_memory_equal(text + kept, whole + header, row);
        assert_true(rows < 0 ? kept == header : kept <= cut);
        write_text(whole);
    }
    sb_arena_free(&arena);
}

static void writers_at_one_time_do_not_mix(void **state)
{
    (void)state;
    enum { WRITERS = 6, TIMES = 40, ROWS = 3 };
    for (int w = 0; w < WRITERS; w++) {
        const pid_t pid = fork();
        assert_true(pid >= 0);
        if (pid > 0)
            continue;
        char name[16];
        snprintf(name, sizeof name, "w%d", w);
        for (int i = 0; i < ROWS; i++)
            history_row[i].commit = name;
        bool good = true;
        for (int t = 0; good && t < TIMES; t++)
            good = sb_history_append(path, history_row, ROWS, &err);
        _exit(good ? 0 : 1);
    }
    for (int w = 0; w < WRITERS; w++) {
        int status;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
    struct sb_history history = {0};
    assert_true(sb_history_read(path, &history, &err));
    assert_int_equal(history.count, WRITERS * TIMES * ROWS);
    int changes = 0;
    for (int i = 0; i < history.count; i++) { // what was appended at once is together
        assert_string_equal(history.row[i].commit, history.row[i - i % ROWS].commit);
        check_close(history.row[i].ratio, history_row[i % ROWS].ratio, 0);
        changes += i && strcmp(history.row[i].commit, history.row[i - 1].commit) != 0;
    }
    print_message("%d changes of the writer\n", changes);
    sb_history_free(&history);
}

// In a process of its own, since the limit stays.
static void a_disk_that_fills_up_leaves_what_was_there(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    append(3);
    const char *before = read_text(&arena);
    const size_t length = strlen(before);
    const size_t rows = length - strcspn(before, "\n") - 1;
    for (size_t room = 0; room < rows; room += 50) { // within a row, and behind two
        const pid_t pid = fork();
        assert_true(pid >= 0);
        if (pid == 0) {
            const struct rlimit limit = {length + room, length + room};
            signal(SIGXFSZ, SIG_IGN);
            if (setrlimit(RLIMIT_FSIZE, &limit) != 0)
                _exit(2);
            const bool refused = !sb_history_append(path, history_row, 3, &err) &&
                                 err.status == SB_WRITE_FAILED &&
                                 strstr(err.text, "File too large");
            _exit(refused ? 0 : 1);
        }
        int status;
        assert_int_equal(waitpid(pid, &status, 0), pid);
        assert_int_equal(status, 0);
        assert_string_equal(read_text(&arena), before);
    }
    append(1); // with room again
    check_read(4);
    sb_arena_free(&arena);
}

// --- reading -----------------------------------------------------------------------------------

static void a_wrong_cell_is_told_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *from, *to, *says;
    } damage[] = {
        {",1,1.01,", ",1,1.o1,", ".csv:3: ratio is \"1.o1\", a number is wanted"},
        {",1,1.01,", ",1,-1.01,", ".csv:3: ratio is -1.01, a number over 0"},
        {",1,1.01,", ",1,inf,", ".csv:3: ratio is inf, a number over 0"},
        {",1,1.01,", ",1,,",
         ".csv:3: ratio is nan, a number over 0 is wanted where the status"},
        {"2026-01-02T00:00:00Z", "yesterday", ".csv:3: time is \"yesterday\""},
        {"2026-01-02T00:00:00Z", "2026-01-02", ".csv:3: time is \"2026-01-02\""},
        {",c001,", ",,", ".csv:3: commit is empty"},
        {",c001,", ",c001,c001,", ".csv:3: 18 fields; the header has 17"},
        {",c001,", ",\"c001,", "a quote that is not closed"},
    };
    struct sb_arena arena = {0};
    append(3);
    const char *whole = read_text(&arena);
    for (size_t i = 0; i < sizeof damage / sizeof *damage; i++) {
        struct sb_text text = {0};
        const char *at = strstr(whole, damage[i].from);
        assert_non_null(at);
        sb_text_add_n(&text, whole, (size_t)(at - whole));
        sb_text_add(&text, damage[i].to);
        sb_text_add(&text, at + strlen(damage[i].from));
        write_text(text.data);
        check_unreadable(damage[i].says);
        sb_text_free(&text);
    }
    sb_arena_free(&arena);
}

static void a_row_that_is_not_ok_needs_no_ratio(void **state)
{
    (void)state;
    history_row[1].ratio = NAN;
    history_row[1].status = "compile_failed";
    append(3);
    check_read(3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_of_all_zones_become_utc),
        cmocka_unit_test(what_is_no_date_is_refused),
        cmocka_unit_test_setup_teardown(rows_go_behind_one_header, start, stop),
        cmocka_unit_test_setup_teardown(
            a_file_that_is_no_history_is_refused_and_stays_as_it_is, start, stop),
        cmocka_unit_test_setup_teardown(of_a_writer_that_was_killed_no_half_row_stays,
                                        start, stop),
        cmocka_unit_test_setup_teardown(writers_at_one_time_do_not_mix, start, stop),
        cmocka_unit_test_setup_teardown(a_disk_that_fills_up_leaves_what_was_there, start,
                                        stop),
        cmocka_unit_test_setup_teardown(a_wrong_cell_is_told_with_its_line, start, stop),
        cmocka_unit_test_setup_teardown(a_row_that_is_not_ok_needs_no_ratio, start, stop),
    };
    return run_tests(tests);
}
