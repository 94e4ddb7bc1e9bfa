// Google Benchmark's own compare.py on our JSON (Debian: libbenchmark-tools). Its statistics come from
// SciPy, a large package; where that is missing, a few lines take its place, as what is asked here is
// whether compare.py reads the file.
#include "cli_fixture.h"
#include "export_rows.h"

#define COMPARE                                                                          \
    "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=\"$STANDIN\" /usr/bin/python3 "                \
    "/usr/share/benchmark/compare.py --no-color "

static const char scipy_standin[] =
    "import math\n"
    "class Answer:\n"
    "    def __init__(self, pvalue): self.pvalue = pvalue\n"
    "# Normal approximation without ties: enough to tell apart what does not overlap.\n"
    "def mannwhitneyu(a, b, alternative):\n"
    "    u = sum((x > y) + 0.5 * (x == y) for x in a for y in b)\n"
    "    n, m = len(a), len(b)\n"
    "    z = abs(u - n * m / 2) / math.sqrt(n * m * (n + m + 1) / 12)\n"
    "    return Answer(math.erfc(z / math.sqrt(2)))\n"
    "class Means(list):\n"
    "    def any(self): return any(self)\n"
    "def gmean(rows):\n"
    "    if any(x <= 0 for r in rows for x in r): return Means([0.0, 0.0])\n"
    "    return Means(math.exp(sum(map(math.log, c)) / len(c)) for c in zip(*rows))\n";

static bool is_missing(void)
{
    static struct answer answer;
    run_shell(&answer, "test -r /usr/share/benchmark/compare.py && test -x "
                       "/usr/bin/python3");
    if (answer.code != 0) {
        print_message(
            "skipped: no compare.py here: apt-get install libbenchmark-tools\n");
        return true;
    }
    run_shell(&answer, "/usr/bin/python3 -c 'import scipy.stats, numpy' 2>&1");
    if (answer.code == 0) {
        unsetenv("STANDIN");
        return false;
    }
    char path[128];
    snprintf(path, sizeof path, "%s/standin", test_dir);
    setenv("STANDIN", path, 1);
    run_shell(&answer, "mkdir -p @/standin/scipy @/standin/numpy && : "
                       ">@/standin/scipy/__init__.py");
    write_file("standin/scipy/stats.py", scipy_standin);
    write_file("standin/numpy/__init__.py", "from scipy.stats import Means as array\n");
    return false;
}

enum { SAMPLES = 12 };

// Two variants of twelve samples each, the second `factor` times slower than it was, and what has none.
static void write_run(const char *name, double factor)
{
    double ns[2][SAMPLES], cpu_ns[SAMPLES];
    struct sb_export_row rows[] = {run_rows[OK], run_rows[OK], run_rows[LATE]};
    for (int i = 0; i < SAMPLES; i++) {
        ns[0][i] = 1e6 + 1e3 * i;
        ns[1][i] = factor * (2e6 + 1e3 * i);
        cpu_ns[i] = 5e5 + i;
    }
    rows[1].variant = "point=9";
    for (int r = 0; r < 2; r++) {
        rows[r].sample_ns = ns[r];
        rows[r].sample_cpu_ns = cpu_ns;
        rows[r].sample_count = SAMPLES;
        rows[r].frame_ns.point = (ns[r][5] + ns[r][6]) / 2;
    }
    const struct sb_export export = {.name = "x", .row = rows, .row_count = 3};
    char *text = written("gbench-json", &export);
    write_file(name, text);
    free(text);
}

// The rest of the line that starts with `start`.
static const char *line_of(const char *text, const char *start)
{
    for (const char *line = text; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, start, strlen(start)) == 0 && line[strlen(start)] == ' ')
            return line + strlen(start);
    }
    fail_msg("no line %s in\n%s", start, text);
    return NULL;
}

static void benchmarks_of_two_files_are_compared_with_a_test_of_their_samples(
    void **state)
{
    (void)state;
    static struct answer answer;
    write_run("old.json", 1);
    write_run("new.json", 1.25);
    run_shell(&answer, COMPARE "benchmarks @/old.json @/new.json 2>&1");
    if (answer.code != 0)
        fail_msg("%d: %s", answer.code, answer.text);
    check_close(atof(line_of(answer.text, "room/point=9_median")), 0.25, 1e-9);
    check_close(atof(line_of(answer.text, "room/point=8,stage=fragment_median")), 0,
                1e-9);
    // All of one side are above all of the other: p is about 3e-5, and of equal ones 1.
    assert_true(atof(line_of(answer.text, "room/point=9_pvalue")) < 0.001);
    assert_true(atof(line_of(answer.text, "room/point=8,stage=fragment_pvalue")) > 0.9);
    check_contains(answer.text, "U Test, Repetitions: 12 vs 12");
}

// 2.0055 over 1.0055, and the other way about in the names.
static void filters_compare_two_variants_of_one_file(void **state)
{
    (void)state;
    static struct answer answer;
    write_run("old.json", 1);
    run_shell(&answer,
              COMPARE "filters @/old.json 'room/point=8,stage=fragment' 'room/point=9' "
                      "2>&1");
    if (answer.code != 0)
        fail_msg("%d: %s", answer.code, answer.text);
    const char *line = strstr(answer.text, "room/point=9]_median");
    assert_non_null(line);
    check_close(atof(line + strlen("room/point=9]_median")), 2.0055 / 1.0055 - 1, 1e-4);
    assert_true(strstr(answer.text, "room/point=9]_pvalue") != NULL);
}

static void aggregates_alone_and_errors_are_read_too(void **state)
{
    (void)state;
    static struct answer answer;
    char *text = written("gbench-json-aggregates", &run_export);
    write_file("few.json", text);
    free(text);
    text = written("gbench-json", &run_export);
    write_file("all.json", text);
    free(text);
    run_shell(&answer, COMPARE "benchmarks @/few.json @/few.json 2>&1");
    if (answer.code != 0)
        fail_msg("%d: %s", answer.code, answer.text);
    line_of(answer.text, "room/point=8,stage=fragment_mean");
    run_shell(&answer, COMPARE "benchmarks @/all.json @/all.json 2>&1");
    if (answer.code != 0)
        fail_msg("%d: %s", answer.code, answer.text);
    line_of(answer.text, "room/point=10");
}

int main(void)
{
    begin_tests();
    if (is_missing())
        return end_tests(0) ? 1 : 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            benchmarks_of_two_files_are_compared_with_a_test_of_their_samples),
        cmocka_unit_test(filters_compare_two_variants_of_one_file),
        cmocka_unit_test(aggregates_alone_and_errors_are_read_too),
    };
    return end_tests(run_tests(tests));
}
