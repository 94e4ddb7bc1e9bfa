// run --program-cache, from its arguments to its columns. Mesa's own cache is as the program sets it.
#include "cli_gl.h"

#define RUN                                                                              \
    "run -q %s --set width=32 --set height=32 --sweep point=1,2 --rounds 2 "             \
    "--first-look 2 --budget 1 --batch 1 -o @/%s %s"

static void run(struct answer *answer, const char *dir, const char *more)
{
    char line[512];
    snprintf(line, sizeof line, RUN, platform, dir, more);
    run_timed(answer, line);
}

// The sum of a column.
static double total(const char *dir, const char *column)
{
    char name[64];
    struct sb_csv csv;
    double sum = 0;
    snprintf(name, sizeof name, "%s/summary.csv", dir);
    read_csv(name, &csv);
    assert_int_equal(csv.row_count, 3);
    for (int line = 1; line < csv.row_count; line++)
        sum += strtod(csv_cell(&csv, line, column), NULL);
    sb_csv_free(&csv);
    return sum;
}

static void a_second_run_loads_what_the_first_one_compiled(void **state)
{
    (void)state;
    static struct answer answer;
    if (!is_egl() || caps.program_binary == 0)
        skip();
    run(&answer, "cold", "--program-cache @/programs");
    check_close(total("cold", "programs_cached"), 0, 0);
    assert_true(total("cold", "compile_ms") > 0);
    run(&answer, "warm", "--program-cache @/programs");
    check_close(total("warm", "programs_cached"), 2, 0);
    check_close(total("warm", "compile_ms"), 0, 0);
    assert_null(strstr(answer.text, "program cache"));
    check_shell("grep program_cache @/warm/run.json", 0, "/programs\"");

    check_shell("for f in @/programs/*; do echo >>$f; done", 0, "");
    run(&answer, "damaged", "--program-cache @/programs");
    check_contains(answer.text, "is compiled again");
    check_close(total("damaged", "programs_cached"), 0, 0);

    run(&answer, "none", "");
    check_close(total("none", "programs_cached"), 0, 0);
    assert_true(total("none", "compile_ms") > 0);
    check_shell("grep program_cache @/none/run.json", 0, "null");
    check_answer("run --resume @/none --program-cache @/programs", 2,
                 "leave out --program-cache");
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_second_run_loads_what_the_first_one_compiled),
    };
    begin_gl_tests();
    // The context of this process was opened with the driver's cache, which has binaries.
    unsetenv("MESA_SHADER_CACHE_DISABLE");
    return end_tests(run_tests(tests));
}
