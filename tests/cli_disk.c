// Disks that fill up and outputs that are closed: what was measured is kept and shown, and
// no failure to write is a success.
#include "cli_fixture.h"

// A file of more than N blocks of 512 bytes fails with EFBIG, as on a full disk: dash's
// ulimit -f. The program's own output goes through pipes and is not limited.
#define LIMITED(n) "trap '' XFSZ; ulimit -f " n "; exec "
#define RUN        "$SB run --context null -q --sweep point=1,2,4 --half-width 0.0001 "

// Every line has as many commas as the header, outside of quotes, and the last one ends.
static void check_whole_lines(const char *text)
{
    int wanted = -1, commas = 0;
    bool quoted = false;
    for (const char *p = text; *p; p++) {
        quoted ^= *p == '"';
        commas += *p == ',' && !quoted;
        if (*p != '\n')
            continue;
        wanted = wanted < 0 ? commas : wanted;
        assert_int_equal(commas, wanted);
        commas = 0;
    }
    assert_int_equal(text[strlen(text) - 1], '\n');
}

static void a_disk_full_of_samples_keeps_whole_rounds_and_shows_the_table(void **state)
{
    (void)state;
    static struct answer answer;
    // 24 KiB hold run.json and summary.csv, and some eighty rounds.
    run_shell(&answer, "{ " LIMITED("48") RUN "--rounds 4000 -o @/full; } 2>@/said");
    char *said = read_file("said"), *samples = read_file("full/samples.csv");
    assert_int_equal(answer.code, 3);
    check_contains(answer.text, "median ms"); // on stdout
    check_contains(answer.text, "1.00");
    assert_null(strstr(answer.text, "summary.csv")); // it is not up to date
    assert_int_equal(count_lines(said), 1);
    check_contains(said, "full/samples.csv: File too large");
    check_whole_lines(samples);
    const int lines = count_lines(samples);
    assert_true(lines > 30);
    assert_int_equal(lines % 3, 1); // a header and whole rounds
    assert_false(run_is_complete("full/run.json"));
    free(said);
    free(samples);

    // With room again the run goes on where it was.
    check_answer("run --resume @/full --rounds 100 --first-look 10 -q", 0, "median ms");
    samples = read_file("full/samples.csv");
    assert_true(count_lines(samples) > lines);
    check_whole_lines(samples);
    assert_true(run_is_complete("full/run.json"));
    free(samples);
}

static void a_summary_that_cannot_be_written_is_named(void **state)
{
    (void)state;
    check_shell("mkdir -p @/blocked/summary.csv; exec " RUN
                "--rounds 20 --first-look 10 -o @/blocked 2>&1",
                3, "blocked/summary.csv: Is a directory");
    check_shell("mkdir -p @/record/run.json.tmp; exec " RUN
                "--rounds 20 --first-look 10 -o @/record 2>&1",
                3, "record/run.json: Is a directory");
}

static void a_start_that_failed_leaves_a_folder_that_can_be_used(void **state)
{
    (void)state;
    check_answer("run --context null -q --timer elapsd -o @/again", 2, "unknown timer");
    check_answer("run --context null -q --rounds 20 --first-look 10 -o @/again", 0,
                 "results:");
    char *samples = read_file("again/samples.csv");
    assert_int_equal(count_lines(samples), 1 + 20); // one header
    free(samples);
}

static void output_that_is_lost_is_no_success(void **state)
{
    (void)state;
    static const char *const words[] = {"list",
                                        "show",
                                        "--version",
                                        "--help",
                                        "run --help",
                                        "list axes --json",
                                        "run --context null -q --rounds 20 -o @/lost"};
    if (access("/dev/full", W_OK) != 0)
        skip();
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char line[256];
        snprintf(line, sizeof line, "exec $SB %s 2>&1 >/dev/full", words[i]);
        check_shell(line, 3, "stdout");
        snprintf(line, sizeof line, "rm -rf @/lost; exec $SB %s 2>&1 >&-", words[i]);
        check_shell(line, 3, "stdout");
    }
}

// With stdout closed, samples.csv would be descriptor 1.
static void a_closed_output_never_goes_into_a_file(void **state)
{
    (void)state;
    check_shell("exec " RUN "--rounds 20 --first-look 10 --json -o @/closed 2>&1 >&-", 3,
                "stdout");
    char *samples = read_file("closed/samples.csv");
    check_whole_lines(samples);
    assert_int_equal(count_lines(samples), 1 + 3 * 20);
    free(samples);
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disk_full_of_samples_keeps_whole_rounds_and_shows_the_table),
        cmocka_unit_test(a_summary_that_cannot_be_written_is_named),
        cmocka_unit_test(a_start_that_failed_leaves_a_folder_that_can_be_used),
        cmocka_unit_test(output_that_is_lost_is_no_success),
        cmocka_unit_test(a_closed_output_never_goes_into_a_file),
    };
    return end_tests(run_tests(tests));
}
