#include "test.h"

#include <unistd.h>

#include "base/file.h"
#include "results/csv.h"

static char path[64];

static void write_text(const char *text)
{
    struct sb_error err = {0};
    assert_true(sb_file_replace(path, text, strlen(text), &err));
}

static void a_row_reads_back_as_it_was_written(void **state)
{
    (void)state;
    struct sb_sample_row row, back;
    struct sb_text text = {0};
    struct sb_csv csv = {0};
    struct sb_error err = {0};
    sb_sample_row_init(&row);
    row.process = 2;
    row.variant = "note=\"a, b\"\nnext line";
    row.scene = "sphere";
    row.gpu_ns = 0; // a value, unlike the absent wall_ns
    sb_csv_header(&text, sb_sample_columns, sb_sample_column_count, NULL);
    sb_csv_row(&text, sb_sample_columns, sb_sample_column_count, NULL, &row);
    write_text(text.data);

    assert_true(sb_csv_read(path, &csv, &err));
    assert_int_equal(csv.row_count, 2);
    assert_int_equal(csv.column_count, sb_sample_column_count);
    sb_sample_row_init(&back);
    assert_true(
        sb_csv_get(&csv, 1, sb_sample_columns, sb_sample_column_count, &back, &err));
    assert_string_equal(back.variant, row.variant);
    assert_int_equal(back.process, 2);
    assert_int_equal(back.gpu_ns, 0);
    assert_true(back.wall_ns == SB_NO_COUNT);
    assert_null(back.timer_source);
    sb_csv_free(&csv);
    sb_text_free(&text);
}

static void a_summary_row_has_a_cell_for_every_axis_and_column(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    struct sb_variant variant;
    struct sb_row row;
    struct sb_text text = {0};
    struct sb_csv csv = {0};
    struct sb_error err = {0};
    sb_variant_init(axes, &variant);
    assert_true(sb_variant_resolve(axes, &variant, &err));
    sb_row_init(&row);
    row.axes = &variant;
    row.median_ms = 1.0 / 3;
    sb_csv_header(&text, sb_summary_columns, sb_summary_column_count, axes);
    sb_csv_row(&text, sb_summary_columns, sb_summary_column_count, axes, &row);
    write_text(text.data);

    assert_true(sb_csv_read(path, &csv, &err));
    assert_int_equal(csv.column_count, sb_summary_column_count - 1 + axes->count);
    assert_string_equal(csv.cell[1][sb_csv_column(&csv, "stage")], "fragment");
    // Without spots the cone is moot, and empty.
    assert_string_equal(csv.cell[1][sb_csv_column(&csv, "cone")], "");
    assert_string_equal(csv.cell[1][sb_csv_column(&csv, "max_err")], "");
    check_close(strtod(csv.cell[1][sb_csv_column(&csv, "median_ms")], NULL), 1.0 / 3, 0);
    sb_csv_free(&csv);
    sb_text_free(&text);
}

static void column_names_are_unique_words(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    for (int i = 0; i < sb_summary_column_count; i++) {
        const char *name = sb_summary_columns[i].name;
        if (!name)
            continue;
        assert_int_equal(strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_"),
                         strlen(name));
        assert_int_equal(sb_axes_find(axes, name), -1);
        for (int j = 0; j < i; j++)
            if (sb_summary_columns[j].name)
                assert_string_not_equal(name, sb_summary_columns[j].name);
    }
}

static void broken_files_name_the_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "empty"},
        {"a,b\n1,2\n3\n", ":3: 1 fields; the header has 2"},
        {"a,b\n1,\"2\n", ":2: a quote that is not closed"},
        {"a,b\n\"1\"x,2\n", ":2: a quote that is not closed, or text behind one"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct sb_csv csv = {0};
        struct sb_error err = {0};
        write_text(cases[i].text);
        assert_false(sb_csv_read(path, &csv, &err));
        assert_int_equal(err.status, SB_BAD_INPUT);
        check_contains(err.text, cases[i].message);
        check_contains(err.text, path);
        sb_csv_free(&csv);
    }
}

static void a_half_written_last_line_is_left_out(void **state)
{
    (void)state;
    struct sb_csv csv = {0};
    struct sb_error err = {0};
    write_text("a,b\n1,2\n3,");
    assert_true(sb_csv_read(path, &csv, &err));
    assert_int_equal(csv.row_count, 2);
    sb_csv_free(&csv);
}

static void carriage_returns_before_line_ends_are_dropped(void **state)
{
    (void)state;
    struct sb_csv csv = {0};
    struct sb_error err = {0};
    write_text("a,b\r\n1,\"2\"\r\n");
    assert_true(sb_csv_read(path, &csv, &err));
    assert_string_equal(csv.cell[0][1], "b");
    assert_string_equal(csv.cell[1][1], "2");
    sb_csv_free(&csv);
}

static void a_word_where_a_number_belongs_is_named(void **state)
{
    (void)state;
    struct sb_csv csv = {0};
    struct sb_error err = {0};
    struct sb_sample_row row;
    write_text("round,wall_ns\n1,much\n");
    assert_true(sb_csv_read(path, &csv, &err));
    sb_sample_row_init(&row);
    assert_false(
        sb_csv_get(&csv, 1, sb_sample_columns, sb_sample_column_count, &row, &err));
    check_contains(err.text, "line 2: wall_ns is \"much\"");
    sb_csv_free(&csv);
}

int main(void)
{
    snprintf(path, sizeof path, "/tmp/shadebench-csv-%ld", (long)getpid());
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_reads_back_as_it_was_written),
        cmocka_unit_test(a_summary_row_has_a_cell_for_every_axis_and_column),
        cmocka_unit_test(column_names_are_unique_words),
        cmocka_unit_test(broken_files_name_the_line),
        cmocka_unit_test(a_half_written_last_line_is_left_out),
        cmocka_unit_test(carriage_returns_before_line_ends_are_dropped),
        cmocka_unit_test(a_word_where_a_number_belongs_is_named),
    };
    const int failed = run_tests(tests);
    unlink(path);
    return failed;
}
