#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/report.h"
#include "cli/table.h"

// Only what differs between the rows needs a column. An axis that is moot in some rows and
// has one value in the others does not differ.
static bool axis_varies(const struct sb_axes *axes, const struct sb_row *row, int count,
                        int axis)
{
    struct sb_text seen = {0}, other = {0};
    bool varies = false;
    for (int i = 0; i < count && !varies; i++) {
        sb_text_clear(&other);
        sb_variant_value_text(axes, row[i].axes, axis, &other);
        if (!seen.length)
            sb_text_add(&seen, sb_text_get(&other));
        varies = other.length && strcmp(seen.data, other.data) != 0;
    }
    sb_text_free(&seen);
    sb_text_free(&other);
    return varies && axes->row[axis].kind != SB_PLATFORM;
}

// A shorthand shows what it sets; its terms would repeat it ten times over.
static bool is_set_by_shorthand(const struct sb_axes *axes, const struct sb_row *row,
                                int count, int axis)
{
    for (int i = 0; i < count; i++)
        if (sb_variant_given(row[i].axes, axis))
            return false;
    for (int a = 0; a < axes->count; a++)
        for (int v = 0; v < axes->row[a].value_count; v++)
            if (strstr(axes->row[a].values[v].sets, axes->row[axis].name))
                return true;
    return false;
}

static bool scene_varies(const struct sb_row *row, int count)
{
    for (int i = 1; i < count; i++)
        if (strcmp(row[i].scene, row[0].scene) != 0)
            return true;
    return false;
}

static void real_cell(struct sb_table *table, const char *format, double value)
{
    char text[64] = "";
    if (!isnan(value))
        snprintf(text, sizeof text, format, value);
    sb_table_cell(table, text);
}

static void add_times(struct sb_table *table, const struct sb_row *row, bool statuses)
{
    const double half =
        fmax(row->ci_hi_ms - row->median_ms, row->median_ms - row->ci_lo_ms);
    real_cell(table, "%.3f", row->median_ms);
    real_cell(table, "%.1f %%", 100 * half / row->median_ms);
    real_cell(table, row->fps < 100 ? "%.1f" : "%.0f", row->fps);
    real_cell(table, "%.2f", row->ns_per_fragment);
    real_cell(table, "%.2f", row->ratio);
    if (statuses)
        sb_table_cell(table, row->status);
}

// The same words about many rows are said once.
static void print_notes(const struct sb_row *row, int count)
{
    for (int i = 0; i < count; i++) {
        bool said = !row[i].note;
        int others = 0;
        for (int j = 0; j < count && !said; j++)
            if (j != i && row[j].note && strcmp(row[j].note, row[i].note) == 0) {
                said = j < i;
                others++;
            }
        if (!said && others)
            printf("%s and %d more: %s\n", row[i].variant, others, row[i].note);
        else if (!said)
            printf("%s: %s\n", row[i].variant, row[i].note);
    }
}

static void print_statuses(const struct sb_row *row, int count)
{
    bool said[SB_STATUS_COUNT] = {[SB_OK] = true};
    for (int i = 0; i < count; i++) {
        const enum sb_status status = sb_status_find(row[i].status);
        if (!said[status])
            printf("%s: %s\n", row[i].status, sb_status_rows[status].help);
        said[status] = true;
    }
}

// An axis that not all rows were given, or not with the same value.
static bool is_given_differently(const struct sb_row *row, int count, int axis)
{
    for (int i = 1; i < count; i++)
        if (sb_variant_given(row[i].axes, axis) != sb_variant_given(row[0].axes, axis) ||
            row[i].axes->value[axis] != row[0].axes->value[axis])
            return true;
    return false;
}

static bool presets_vary(const struct sb_suite *suite, int count)
{
    for (int i = 1; i < count; i++)
        if (suite->entry[i].preset != suite->entry[0].preset &&
            strcmp(suite->entry[i].preset, suite->entry[0].preset) != 0)
            return true;
    return false;
}

// The part of the row's id that sets it apart from the others; `text` may hold the preset.
static void distinct_id(const struct sb_axes *axes, const struct sb_row *rows, int count,
                        const struct sb_row *row, struct sb_text *text)
{
    struct sb_text value = {0};
    for (int a = 0; a < axes->count; a++) {
        sb_text_clear(&value);
        sb_variant_value_text(axes, row->axes, a, &value);
        if (value.length && sb_variant_given(row->axes, a) &&
            is_given_differently(rows, count, a))
            sb_text_printf(text, "%s%s=%s", text->length ? "," : "", axes->row[a].name,
                           value.data);
    }
    if (!text->length)
        sb_text_add(text, "base");
    sb_text_free(&value);
}

// What tells the rows apart: a column for each axis that varies or, where these are many,
// one column with the distinct part of the id.
enum { AXIS_COLUMNS_MAX = 5 };

struct key_columns {
    bool scene, id, axis[SB_AXIS_MAX];
    bool preset; // in the id
};

static void add_key_columns(struct sb_table *table, const struct sb_suite *suite,
                            const struct sb_row *row, int count, struct key_columns *key)
{
    const struct sb_axes *axes = &suite->axes;
    int shown = 0;
    key->preset = presets_vary(suite, count);
    key->scene = scene_varies(row, count);
    for (int a = 0; a < axes->count; a++) {
        key->axis[a] =
            axis_varies(axes, row, count, a) && !is_set_by_shorthand(axes, row, count, a);
        shown += key->axis[a];
    }
    key->id = shown > AXIS_COLUMNS_MAX || key->preset;
    if (key->scene)
        sb_table_column(table, "scene", false);
    if (key->id)
        sb_table_column(table, "variant", false);
    for (int a = 0; !key->id && a < axes->count; a++)
        if (key->axis[a])
            sb_table_column(table, axes->row[a].name, !axes->row[a].values);
}

static void add_key_cells(struct sb_table *table, const struct sb_suite *suite,
                          const struct sb_row *rows, int count, const struct sb_row *row,
                          const struct key_columns *key)
{
    const struct sb_axes *axes = &suite->axes;
    struct sb_text text = {0};
    if (key->scene)
        sb_table_cell(table, row->scene);
    if (key->preset)
        sb_text_add(&text, suite->entry[row - rows].preset);
    if (key->id) {
        distinct_id(axes, rows, count, row, &text);
        sb_table_cell(table, sb_text_get(&text));
    }
    for (int a = 0; !key->id && a < axes->count; a++) {
        sb_text_clear(&text);
        sb_variant_value_text(axes, row->axes, a, &text);
        if (key->axis[a])
            sb_table_cell(table, sb_text_get(&text));
    }
    sb_text_free(&text);
}

void sb_report_table(const struct sb_suite *suite, const struct sb_row *row, int count)
{
    struct sb_table *table = sb_table_new();
    struct key_columns key;
    bool statuses = false;
    add_key_columns(table, suite, row, count, &key);
    for (int i = 0; i < count; i++)
        statuses |= strcmp(row[i].status, "ok") != 0;
    sb_table_column(table, "median ms", true);
    sb_table_column(table, "±", true);
    sb_table_column(table, "fps", true);
    sb_table_column(table, "ns/fragment", true);
    sb_table_column(table, "ratio", true);
    if (statuses)
        sb_table_column(table, "status", false);
    for (int i = 0; i < count; i++) {
        add_key_cells(table, suite, row, count, &row[i], &key);
        add_times(table, &row[i], statuses);
    }
    sb_table_print(table);
    sb_table_free(&table);
    print_statuses(row, count);
    print_notes(row, count);
}

static json_t *cell_json(const struct sb_row *row, const struct sb_column *column)
{
    const void *cell = (const char *)row + column->offset;
    if (column->type == SB_TEXT)
        return *(const char *const *)cell ? json_string(*(const char *const *)cell)
                                          : json_null();
    if (column->type == SB_REAL)
        return isfinite(*(const double *)cell) ? json_real(*(const double *)cell)
                                               : json_null();
    return *(const int64_t *)cell != SB_NO_COUNT ? json_integer(*(const int64_t *)cell)
                                                 : json_null();
}

static void set_axes(json_t *object, const struct sb_axes *axes, const struct sb_row *row)
{
    struct sb_text text = {0};
    for (int a = 0; a < axes->count; a++) {
        sb_text_clear(&text);
        sb_variant_value_text(axes, row->axes, a, &text);
        json_object_set_new(object, axes->row[a].name,
                            !text.length          ? json_null()
                            : axes->row[a].values ? json_string(text.data)
                                                  : json_real(row->axes->value[a]));
    }
    sb_text_free(&text);
}

json_t *sb_report_json(const struct sb_axes *axes, const struct sb_row *row, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; i++) {
        json_t *object = json_object();
        for (int c = 0; c < sb_summary_column_count; c++) {
            const struct sb_column *column = &sb_summary_columns[c];
            if (column->type == SB_AXES)
                set_axes(object, axes, &row[i]);
            else
                json_object_set_new(object, column->name, cell_json(&row[i], column));
        }
        json_array_append_new(list, object);
    }
    return list;
}
