#include <math.h>
#include <stdio.h>
#include <string.h>

#include "analyse/pareto.h"
#include "cli/report.h"

void sb_report_level(struct sb_table *table, const struct sb_row *row)
{
    const double half =
        fmax(row->ci_hi_ms - row->median_ms, row->median_ms - row->ci_lo_ms);
    sb_table_real(table, "%.3f", row->median_ms);
    sb_table_real(table, "%.1f %%", 100 * half / row->median_ms);
}

static void add_times(struct sb_table *table, const struct sb_row *row, bool statuses)
{
    sb_report_level(table, row);
    sb_table_real(table, row->fps < 100 ? "%.1f" : "%.0f", row->fps);
    sb_table_real(table, "%.2f", row->ns_per_fragment);
    sb_table_real(table, "%.2f", row->ratio);
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

static bool has_errors(const struct sb_row *row, int count)
{
    for (int i = 0; i < count; i++)
        if (!isnan(row[i].max_err))
            return true;
    return false;
}

void sb_report_mark(const struct sb_keys *keys, const struct sb_row *row,
                    struct sb_text *text)
{
    struct sb_text id = {0};
    for (int i = 0; row->dominated_by && !id.length && i < keys->count; i++)
        if (strcmp(keys->row[i].variant, row->dominated_by) == 0 &&
            strcmp(keys->row[i].scene, row->scene) == 0)
            sb_keys_id(keys, &keys->row[i], &id);
    sb_pareto_text(row, id.length ? id.data : row->dominated_by, text);
    sb_text_free(&id);
}

static void add_errors(struct sb_table *table, const struct sb_keys *keys,
                       const struct sb_row *row)
{
    struct sb_text mark = {0};
    sb_table_real(table, "%.2g", row->max_err);
    sb_table_real(table, "%.2g", row->p999_err);
    sb_table_real(table, "%.2g", row->flip_mean);
    sb_report_mark(keys, row, &mark);
    sb_table_cell(table, sb_text_get(&mark));
    sb_text_free(&mark);
}

void sb_report_table(const struct sb_axes *axes, const struct sb_row *row, int count)
{
    struct sb_table *table = sb_table_new();
    struct sb_keys keys;
    const bool errors = has_errors(row, count);
    bool statuses = false;
    sb_keys_make(&keys, axes, row, count);
    sb_keys_columns(&keys, table);
    for (int i = 0; i < count; i++)
        statuses |= strcmp(row[i].status, "ok") != 0;
    sb_table_column(table, "median ms", true);
    sb_table_column(table, "±", true);
    sb_table_column(table, "fps", true);
    sb_table_column(table, "ns/fragment", true);
    sb_table_column(table, "ratio", true);
    if (statuses)
        sb_table_column(table, "status", false);
    static const char *const titles[] = {"max err", "p99.9", "FLIP", "front"};
    for (int i = 0; errors && i < 4; i++)
        sb_table_column(table, titles[i], i < 3);
    for (int i = 0; i < count; i++) {
        sb_keys_cells(&keys, table, &row[i]);
        add_times(table, &row[i], statuses);
        if (errors)
            add_errors(table, &keys, &row[i]);
    }
    sb_table_print(table);
    sb_table_free(&table);
    print_statuses(row, count);
    print_notes(row, count);
}

json_t *sb_report_cell_json(const void *row, const struct sb_column *column)
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
                json_object_set_new(object, column->name,
                                    sb_report_cell_json(&row[i], column));
        }
        json_array_append_new(list, object);
    }
    return list;
}
