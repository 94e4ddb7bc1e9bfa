#include <string.h>

#include "cli/keys.h"
#include "results/rows.h"

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

// An axis that not all rows were given, or not with the same value.
static bool is_given_differently(const struct sb_row *row, int count, int axis)
{
    for (int i = 1; i < count; i++)
        if (sb_variant_given(row[i].axes, axis) != sb_variant_given(row[0].axes, axis) ||
            row[i].axes->value[axis] != row[0].axes->value[axis])
            return true;
    return false;
}

static bool presets_vary(const struct sb_row *row, int count)
{
    struct sb_text first = {0}, other = {0};
    bool vary = false;
    for (int i = 1; i < count && !vary; i++)
        vary =
            strcmp(sb_row_preset(&row[0], &first), sb_row_preset(&row[i], &other)) != 0;
    sb_text_free(&first);
    sb_text_free(&other);
    return vary;
}

enum { AXIS_COLUMNS_MAX = 5 };

void sb_keys_make(struct sb_keys *keys, const struct sb_axes *axes,
                  const struct sb_row *row, int count)
{
    int shown = 0;
    *keys = (struct sb_keys){.axes = axes, .row = row, .count = count};
    keys->preset = presets_vary(row, count);
    keys->scene = scene_varies(row, count);
    for (int a = 0; a < axes->count; a++) {
        keys->axis[a] =
            axis_varies(axes, row, count, a) && !is_set_by_shorthand(axes, row, count, a);
        shown += keys->axis[a];
    }
    keys->id = shown > AXIS_COLUMNS_MAX || keys->preset;
}

void sb_keys_columns(const struct sb_keys *keys, struct sb_table *table)
{
    const struct sb_axes *axes = keys->axes;
    if (keys->scene)
        sb_table_column(table, "scene", false);
    if (keys->id)
        sb_table_column(table, "variant", false);
    for (int a = 0; !keys->id && a < axes->count; a++)
        if (keys->axis[a])
            sb_table_column(table, axes->row[a].name, !axes->row[a].values);
}

void sb_keys_id(const struct sb_keys *keys, const struct sb_row *row,
                struct sb_text *text)
{
    const struct sb_axes *axes = keys->axes;
    struct sb_text value = {0};
    const size_t start = text->length;
    if (keys->preset)
        sb_text_add(text, sb_row_preset(row, &value));
    for (int a = 0; a < axes->count; a++) {
        sb_text_clear(&value);
        sb_variant_value_text(axes, row->axes, a, &value);
        if (value.length && sb_variant_given(row->axes, a) &&
            is_given_differently(keys->row, keys->count, a))
            sb_text_printf(text, "%s%s=%s", text->length > start ? "," : "",
                           axes->row[a].name, value.data);
    }
    if (text->length == start)
        sb_text_add(text, "base");
    sb_text_free(&value);
}

void sb_keys_cells(const struct sb_keys *keys, struct sb_table *table,
                   const struct sb_row *row)
{
    const struct sb_axes *axes = keys->axes;
    struct sb_text text = {0};
    if (keys->scene)
        sb_table_cell(table, row->scene);
    if (keys->id) {
        sb_keys_id(keys, row, &text);
        sb_table_cell(table, sb_text_get(&text));
    }
    for (int a = 0; !keys->id && a < axes->count; a++) {
        sb_text_clear(&text);
        sb_variant_value_text(axes, row->axes, a, &text);
        if (keys->axis[a])
            sb_table_cell(table, sb_text_get(&text));
    }
    sb_text_free(&text);
}
