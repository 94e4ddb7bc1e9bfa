// A suite with axes of its own runs to the CSV: its columns, values, ids and sources.
#include "measure_fixture.h"

static const char suite_text[] =
    "suite: own\n"
    "axes:\n"
    "  - {name: curve, kind: quality, define: CURVE, help: which curve,\n"
    "     values: [linear, {name: cubic, text: cubic_fast, help: smoother}], init: "
    "cubic}\n"
    "  - {name: taps, kind: quality, define: NR_TAPS, min: 1, max: 16, init: 4,\n"
    "     whole: true, when: curve=cubic}\n"
    "base: {point: 1}\n"
    "sweep: {taps: [1, 2.0]}\n"
    "cross: {curve: [linear, cubic]}\n"
    "measure: {rounds: 20, first_look: 10}\n";

// A time that depends on the two axes: what the rows tell must have come from these jobs.
static double time_of_own_axes(void *user, const struct sb_job *job,
                               const struct sb_shot *shot, int64_t count)
{
    (void)user;
    (void)shot;
    (void)count;
    const double *value = job->variant.value;
    return 1e6 * (1 + 10 * value[SB_AXIS_BUILTIN_COUNT]) +
           1e5 * value[SB_AXIS_BUILTIN_COUNT + 1];
}

static void begin(struct fixture *f)
{
    char path[128];
    *f = (struct fixture){0};
    sb_log_set_level(SB_LOG_QUIET);
    snprintf(f->dir, sizeof f->dir, "/tmp/shadebench-own-XXXXXX");
    assert_non_null(mkdtemp(f->dir));
    snprintf(path, sizeof path, "%s/suite.yaml", f->dir);
    assert_true(sb_file_replace(path, suite_text, strlen(suite_text), &f->err));
    const struct sb_suite_params params = {.path = path};
    if (!sb_suite_load(&params, &f->suite, &f->err))
        fail_msg("%s", f->err.text);
    unlink(path);
    next_script.frame_ns = time_of_own_axes;
}

static const char *cell(const struct sb_csv *csv, int line, const char *column)
{
    const int at = sb_csv_column(csv, column);
    if (at < 0)
        fail_msg("no column %s", column);
    return csv->cell[line][at];
}

static void own_axes_are_columns_values_ids_and_defines(void **state)
{
    (void)state;
    // curve=linear makes taps moot, so linear with 1 and with 2 taps are one variant, and
    // its taps take 4, their init.
    static const struct {
        const char *id, *curve, *taps;
        double ms;
    } wanted[] = {
        {"point=1,curve=linear", "linear", "", 1.4},
        {"point=1,curve=cubic,taps=1", "cubic", "1", 11.1},
        {"point=1,curve=cubic,taps=2", "cubic", "2", 11.2},
    };
    struct fixture f;
    struct sb_arena arena = {0};
    struct sb_csv csv = {0};
    begin(&f);
    if (!fixture_run(&f, false))
        fail_msg("%s", f.err.text);
    assert_true(sb_csv_read(sb_path_join(&arena, f.dir, "summary.csv"), &csv, &f.err));
    assert_int_equal(csv.row_count, 1 + 3);
    // Behind the built-in axes, in the order of the suite.
    const int curve = sb_csv_column(&csv, "curve");
    assert_int_equal(curve, 2 + SB_AXIS_BUILTIN_COUNT);
    assert_int_equal(sb_csv_column(&csv, "taps"), curve + 1);
    assert_int_equal(sb_csv_column(&csv, "renderer"), curve + 2);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(cell(&csv, i + 1, "variant"), wanted[i].id);
        assert_string_equal(cell(&csv, i + 1, "curve"), wanted[i].curve);
        assert_string_equal(cell(&csv, i + 1, "taps"), wanted[i].taps);
        assert_string_equal(cell(&csv, i + 1, "point"), "1");
        assert_string_equal(cell(&csv, i + 1, "status"), "ok");
        check_close(strtod(cell(&csv, i + 1, "median_ms"), NULL), wanted[i].ms, 1e-9);
        // Each define is in the source, so no two sources are equal.
        for (int j = 0; j < i; j++)
            assert_string_not_equal(cell(&csv, i + 1, "source_hash"),
                                    cell(&csv, j + 1, "source_hash"));
    }
    sb_csv_free(&csv);

    fixture_samples(&f, &csv);
    assert_int_equal(csv.row_count, 1 + 3 * 20);
    int seen[3] = {0};
    for (int line = 1; line < csv.row_count; line++)
        for (int i = 0; i < 3; i++)
            seen[i] += strcmp(cell(&csv, line, "variant"), wanted[i].id) == 0;
    for (int i = 0; i < 3; i++)
        assert_int_equal(seen[i], 20);
    sb_csv_free(&csv);
    sb_arena_free(&arena);
    fixture_end(&f);
}

static void an_own_axis_cannot_hide_a_column(void **state)
{
    (void)state;
    struct fixture f;
    begin(&f);
    // What the loader cannot know: the names of the columns.
    f.suite.axes.row[SB_AXIS_BUILTIN_COUNT].name = "fps";
    assert_false(fixture_run(&f, false));
    assert_int_equal(f.err.status, SB_BAD_INPUT);
    check_contains(f.err.text, "an axis cannot be called \"fps\"");
    fixture_end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_axes_are_columns_values_ids_and_defines),
        cmocka_unit_test(an_own_axis_cannot_hide_a_column),
    };
    return run_tests(tests);
}
