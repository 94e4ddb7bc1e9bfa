// What --json prints is JSON, and holds what the text shows.
#include "cli_fixture.h"

#define RUN "run --context null -q --sweep point=1,2 --rounds 20 --first-look 20 "

static const char *const lists[] = {"suites",   "presets", "scenes",  "axes",
                                    "contexts", "timers",  "columns", "settings",
                                    "statuses", "formats"};

// Every word of every JSON row stands in the text, too, and nothing is left out.
static void every_list_is_the_same_in_text_and_in_json(void **state)
{
    (void)state;
    static struct answer answer;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        char line[64];
        size_t r;
        const json_t *row;
        snprintf(line, sizeof line, "list %s", lists[i]);
        run_program(&answer, line);
        assert_int_equal(answer.code, 0);
        snprintf(line, sizeof line, "list %s --json", lists[i]);
        json_t *json = run_json(line, 0);
        assert_true(json_is_array(json));
        // One line is the head of the table.
        assert_int_equal(count_lines(answer.text), 1 + (int)json_array_size(json));
        json_array_foreach(json, r, row)
        {
            const char *title;
            const json_t *cell;
            assert_true(json_object_size(row) >= 2);
            json_object_foreach((json_t *)row, title, cell)
            {
                check_contains(answer.text, title);
                check_contains(answer.text, json_string_value(cell));
            }
        }
        json_decref(json);
    }
}

static void a_run_tells_the_same_in_text_json_and_csv(void **state)
{
    (void)state;
    struct sb_csv csv;
    json_t *json = run_json(RUN "--json -o @/run", 0);
    const json_t *rows = json_object_get(json, "rows"), *row;
    size_t i;
    check_contains(json_string_value(json_object_get(json, "dir")), test_dir);
    assert_true(json_is_false(json_object_get(json, "interrupted")));
    read_csv("run/summary.csv", &csv);
    assert_int_equal(json_array_size(rows), 2);
    assert_int_equal(csv.row_count, 3);
    json_array_foreach(rows, i, row)
    {
        assert_int_equal(json_object_size(row), csv.column_count);
        for (int c = 0; c < csv.column_count; c++) {
            const char *text = csv.cell[i + 1][c];
            const json_t *value = json_object_get(row, csv.cell[0][c]);
            assert_non_null(value);
            if (json_is_string(value))
                assert_string_equal(json_string_value(value), text);
            else if (json_is_number(value))
                check_close(json_number_value(value), strtod(text, NULL), 0);
            else
                assert_string_equal(text, "");
        }
    }
    json_decref(json);

    // The table, of the same files.
    static struct answer answer;
    char median[32];
    run_program(&answer, "run --resume @/run");
    for (int r = 1; r <= 2; r++) {
        snprintf(median, sizeof median, " %.3f ",
                 strtod(csv_cell(&csv, r, "median_ms"), NULL));
        check_contains(answer.text, median);
    }
    sb_csv_free(&csv);
}

static void show_holds_the_sources_and_the_plan(void **state)
{
    (void)state;
    static struct answer answer;
    run_program(&answer, "show point=4,stage=vertex");
    json_t *json = run_json("show point=4,stage=vertex --json", 0);
    assert_string_equal(json_string_value(json_object_get(json, "variant")),
                        "point=4,stage=vertex");
    const json_t *program = json_array_get(json_object_get(json, "programs"), 0);
    assert_string_equal(json_string_value(json_object_get(program, "role")), "shade");
    const char *vertex = json_string_value(json_object_get(program, "vertex"));
    const char *fragment = json_string_value(json_object_get(program, "fragment"));
    check_contains(vertex, "#define NR_POINT_LIGHTS 4\n");
    check_contains(answer.text, vertex);
    check_contains(answer.text, fragment);
    json_decref(json);

    size_t i;
    const json_t *entry;
    run_program(&answer, "show lights");
    json = run_json("show lights --json", 0);
    assert_int_equal(count_lines(answer.text), 2 + (int)json_array_size(json));
    json_array_foreach(json, i, entry)
    {
        check_contains(answer.text, json_string_value(json_object_get(entry, "variant")));
        check_contains(answer.text,
                       json_string_value(json_object_get(entry, "source_hash")));
    }
    json_decref(json);
}

static void probe_holds_caps_timers_and_precision(void **state)
{
    (void)state;
    static struct answer answer;
    run_program(&answer, "probe --context null");
    json_t *json = run_json("probe --context null --json", 0);
    const json_t *caps = json_object_get(json, "caps");
    check_contains(answer.text, json_string_value(json_object_get(caps, "renderer")));
    const json_t *timer = json_array_get(json_object_get(json, "timers"), 0);
    assert_string_equal(json_string_value(json_object_get(timer, "timer")), "scripted");
    assert_true(json_is_true(json_object_get(timer, "chosen")));
    const json_t *precision = json_object_get(json, "precision");
    // Five carriers, of which the vertex stage has four, at three precisions.
    assert_int_equal(json_array_size(precision), 3 * (5 + 4));
    for (size_t i = 0; i < json_array_size(precision); i++) {
        static const char *const words[] = {"stage", "carrier", "precision", "verdict"};
        const json_t *one = json_array_get(precision, i);
        for (size_t k = 0; k < sizeof words / sizeof *words; k++)
            check_contains(answer.text,
                           json_string_value(json_object_get(one, words[k])));
        assert_string_equal(json_string_value(json_object_get(one, "effective")), "fp32");
        const json_t *reading = json_object_get(one, "reading");
        check_close(json_number_value(json_object_get(reading, "add")), 2050, 0);
    }
    json_decref(json);
}

// A failure is a line on stderr, and nothing on stdout that could be taken for a result.
static void failures_print_no_json(void **state)
{
    (void)state;
    check_shell("exec $SB list nothing --json 2>/dev/null | wc -c", 0, "0\n");
    check_shell("exec $SB run nothing --json 2>/dev/null | wc -c", 0, "0\n");
    check_shell("exec $SB show point=x --json 2>/dev/null | wc -c", 0, "0\n");
}

int main(void)
{
    begin_tests();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_list_is_the_same_in_text_and_in_json),
        cmocka_unit_test(a_run_tells_the_same_in_text_json_and_csv),
        cmocka_unit_test(show_holds_the_sources_and_the_plan),
        cmocka_unit_test(probe_holds_caps_timers_and_precision),
        cmocka_unit_test(failures_print_no_json),
    };
    return end_tests(run_tests(tests));
}
