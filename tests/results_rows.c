// Rows of summary.csv read back are those that were written.
#include "test.h"

#include <unistd.h>

#include "base/file.h"
#include "math/random.h"
#include "results/rows.h"

enum { ROWS = 200 };

static char path[] = "/tmp/shadebench-rows-XXXXXX";

static void random_variant(struct sb_variant *variant, struct sb_random *random)
{
    const struct sb_axes *axes = sb_axes_builtin();
    struct sb_error err;
    sb_variant_init(axes, variant);
    for (int a = 0; a < axes->count; a++) {
        const struct sb_axis *axis = &axes->row[a];
        const double share = sb_random_unit(random);
        if (sb_random_below(random, 3))
            continue;
        double value = axis->min + share * (axis->max - axis->min);
        if (axis->values)
            value = (double)sb_random_below(random, (uint64_t)axis->value_count);
        else if (axis->flags & SB_WHOLE)
            value = floor(value);
        sb_variant_put(variant, a, value);
    }
    // `needs` may refuse it: it is expanded all the same.
    sb_variant_resolve(axes, variant, &err);
}

static void a_variant_reads_back_with_what_was_given(void **state)
{
    (void)state;
    const struct sb_axes *axes = sb_axes_builtin();
    static struct sb_variant variant[ROWS];
    struct sb_random random = sb_random_seed(3);
    struct sb_rows rows = {0};
    struct sb_text text = {0}, id[ROWS] = {{0}};
    struct sb_error err = {0};
    sb_csv_header(&text, sb_summary_columns, sb_summary_column_count, axes);
    for (int i = 0; i < ROWS; i++) {
        struct sb_row row;
        random_variant(&variant[i], &random);
        sb_row_init(&row);
        if (i % 2)
            sb_text_add(&id[i], "a_preset,");
        sb_variant_id(axes, &variant[i], &id[i]);
        row.axes = &variant[i];
        row.variant = id[i].data;
        row.scene = "sphere";
        row.status = "ok";
        row.max_err = i / 7.0;
        sb_csv_row(&text, sb_summary_columns, sb_summary_column_count, axes, &row);
    }
    assert_true(sb_file_replace(path, text.data, text.length, &err));
    if (!sb_rows_read(path, axes, &rows, &err))
        fail_msg("%s", err.text);
    assert_int_equal(rows.count, ROWS);
    for (int i = 0; i < ROWS; i++) {
        const struct sb_row *row = &rows.row[i];
        assert_ptr_equal(row->axes, &rows.variant[i]);
        assert_string_equal(row->variant, id[i].data);
        check_close(row->max_err, i / 7.0, 0);
        for (int a = 0; a < axes->count; a++) {
            check_close(row->axes->value[a], variant[i].value[a], 0);
            if (!sb_variant_moot(axes, &variant[i], a))
                assert_int_equal(sb_variant_given(row->axes, a),
                                 sb_variant_given(&variant[i], a));
        }
        assert_string_equal(sb_row_preset(row, &text), i % 2 ? "a_preset" : "");
        sb_text_free(&id[i]);
    }
    sb_rows_free(&rows);
    sb_text_free(&text);
}

static void a_preset_is_the_word_before_the_axes(void **state)
{
    (void)state;
    static const char *const cases[][2] = {{"delphi", "delphi"},
                                           {"delphi,stage=vertex", "delphi"},
                                           {"stage=vertex", ""},
                                           {"stage=vertex,point=1", ""},
                                           {"default", ""}};
    struct sb_text text = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct sb_row row = {.variant = cases[i][0]};
        assert_string_equal(sb_row_preset(&row, &text), cases[i][1]);
    }
    sb_text_free(&text);
}

int main(void)
{
    const int fd = mkstemp(path);
    if (fd < 0)
        return 1;
    close(fd);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_variant_reads_back_with_what_was_given),
        cmocka_unit_test(a_preset_is_the_word_before_the_axes),
    };
    const int failed = run_tests(tests);
    unlink(path);
    return failed;
}
