#include <stdlib.h>
#include <string.h>

#include "results/rows.h"

static bool get_axes(const struct sb_csv *csv, int line, const struct sb_axes *axes,
                     struct sb_variant *variant, struct sb_error *err)
{
    for (int a = 0; a < axes->count; a++) {
        const struct sb_axis *axis = &axes->row[a];
        const int column = sb_csv_column(csv, axis->name);
        const char *text = column >= 0 ? csv->cell[line][column] : "";
        double value = 0;
        if (!*text)
            continue;
        if (axis->values && (value = sb_axis_value_expect(axis, text, err)) < 0)
            return false;
        if (!axis->values &&
            !sb_number_read(axis->name, text, axis->min, axis->max, false, &value, err))
            return false;
        variant->value[a] = value;
    }
    return true;
}

bool sb_rows_get(const struct sb_csv *csv, int line, const struct sb_axes *axes,
                 struct sb_variant *variant, struct sb_row *row, struct sb_error *err)
{
    sb_row_init(row);
    row->axes = variant;
    return get_axes(csv, line, axes, variant, err) &&
           sb_csv_get(csv, line, sb_summary_columns, sb_summary_column_count, row, err);
}

// The axis that a word of an id, `axis=value`, gives a value; -1: none.
static int axis_of_word(const struct sb_axes *axes, const char *word)
{
    const size_t length = strcspn(word, "=,");
    for (int a = 0; word[length] == '=' && a < axes->count; a++)
        if (strlen(axes->row[a].name) == length &&
            strncmp(axes->row[a].name, word, length) == 0)
            return a;
    return -1;
}

static void mark_given(const struct sb_axes *axes, const char *id,
                       struct sb_variant *variant)
{
    for (const char *word = id; word; word = strchr(word, ',')) {
        word += *word == ',';
        const int axis = axis_of_word(axes, word);
        if (axis >= 0)
            sb_variant_put(variant, axis, variant->value[axis]);
    }
}

static bool is_known(const struct sb_axes *axes, const char *name)
{
    for (int i = 0; i < sb_summary_column_count; i++)
        if (sb_summary_columns[i].name && strcmp(sb_summary_columns[i].name, name) == 0)
            return true;
    return sb_axes_find(axes, name) >= 0;
}

// The columns of the axes stand between these two.
static bool check_header(const struct sb_csv *csv, const char *path,
                         const struct sb_axes *axes, struct sb_error *err)
{
    static const char *const wanted[] = {"variant", "scene", "renderer", "version",
                                         "status"};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (sb_csv_column(csv, wanted[i]) < 0)
            return sb_fail(err, SB_BAD_INPUT,
                           "%s:1: no column \"%s\"; the summary.csv of a run is wanted",
                           path, wanted[i]);
    for (int i = sb_csv_column(csv, "scene") + 1; i < sb_csv_column(csv, "renderer"); i++)
        if (!is_known(axes, csv->cell[0][i]))
            return sb_fail(err, SB_BAD_INPUT,
                           "%s:1: no axis is called \"%s\"; name the results folder, "
                           "whose suite.yaml may declare it",
                           path, csv->cell[0][i]);
    if (csv->row_count < 2)
        return sb_fail(err, SB_BAD_INPUT, "%s: a header and no rows", path);
    return true;
}

static bool read_row(struct sb_rows *rows, int i, const char *path,
                     const struct sb_axes *axes, struct sb_error *err)
{
    struct sb_row *row = &rows->row[i];
    sb_variant_init(axes, &rows->variant[i]);
    if (!sb_rows_get(&rows->csv, i + 1, axes, &rows->variant[i], row, err))
        return sb_fail(err, SB_BAD_INPUT, "%s:%d: %s", path, i + 2, err->text);
    if (!row->variant || !row->scene || !row->status)
        return sb_fail(err, SB_BAD_INPUT, "%s:%d: no %s", path, i + 2,
                       !row->variant ? "variant"
                       : !row->scene ? "scene"
                                     : "status");
    if (sb_status_find(row->status) == SB_STATUS_COUNT)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s:%d: status is \"%s\"; valid: shadebench list statuses", path,
                       i + 2, row->status);
    mark_given(axes, row->variant, &rows->variant[i]);
    return true;
}

bool sb_rows_read(const char *path, const struct sb_axes *axes, struct sb_rows *rows,
                  struct sb_error *err)
{
    if (!sb_csv_read(path, &rows->csv, err) || !check_header(&rows->csv, path, axes, err))
        return false;
    rows->count = rows->csv.row_count - 1;
    rows->row = sb_alloc((size_t)rows->count * sizeof *rows->row);
    rows->variant = sb_alloc((size_t)rows->count * sizeof *rows->variant);
    bool good = true;
    for (int i = 0; good && i < rows->count; i++)
        good = read_row(rows, i, path, axes, err);
    return good;
}

void sb_rows_free(struct sb_rows *rows)
{
    free(rows->row);
    free(rows->variant);
    sb_csv_free(&rows->csv);
    *rows = (struct sb_rows){0};
}

const char *sb_row_preset(const struct sb_row *row, struct sb_text *text)
{
    const size_t length = strcspn(row->variant, ",");
    sb_text_clear(text);
    if (!memchr(row->variant, '=', length) && strcmp(row->variant, "default") != 0)
        sb_text_add_n(text, row->variant, length);
    return sb_text_get(text);
}
