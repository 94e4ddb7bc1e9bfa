#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "results/csv.h"

void sb_csv_field(struct sb_text *text, const char *field)
{
    if (!strpbrk(field, ",\"\r\n")) {
        sb_text_add(text, field);
        return;
    }
    sb_text_add(text, "\"");
    for (; *field; field++) {
        if (*field == '"')
            sb_text_add(text, "\"");
        sb_text_add_n(text, field, 1);
    }
    sb_text_add(text, "\"");
}

void sb_csv_header(struct sb_text *text, const struct sb_column *columns, int count,
                   const struct sb_axes *axes)
{
    for (int i = 0; i < count; i++) {
        if (i)
            sb_text_add(text, ",");
        if (columns[i].type != SB_AXES) {
            sb_text_add(text, columns[i].name);
            continue;
        }
        for (int a = 0; a < axes->count; a++)
            sb_text_printf(text, "%s%s", a ? "," : "", axes->row[a].name);
    }
    sb_text_add(text, "\n");
}

static void add_axes(struct sb_text *text, const struct sb_axes *axes,
                     const struct sb_variant *variant)
{
    struct sb_text value = {0};
    for (int a = 0; a < axes->count; a++) {
        if (a)
            sb_text_add(text, ",");
        sb_text_clear(&value);
        sb_variant_value_text(axes, variant, a, &value);
        sb_csv_field(text, sb_text_get(&value));
    }
    sb_text_free(&value);
}

static void add_cell(struct sb_text *text, const struct sb_axes *axes,
                     enum sb_column_type type, const void *cell)
{
    switch (type) {
    case SB_TEXT:
        if (*(const char *const *)cell)
            sb_csv_field(text, *(const char *const *)cell);
        break;
    case SB_REAL:
        if (!isnan(*(const double *)cell))
            sb_text_number(text, *(const double *)cell);
        break;
    case SB_COUNT:
        if (*(const int64_t *)cell != SB_NO_COUNT)
            sb_text_printf(text, "%" PRId64, *(const int64_t *)cell);
        break;
    case SB_AXES:
        add_axes(text, axes, *(const struct sb_variant *const *)cell);
        break;
    }
}

void sb_csv_row(struct sb_text *text, const struct sb_column *columns, int count,
                const struct sb_axes *axes, const void *row)
{
    for (int i = 0; i < count; i++) {
        if (i)
            sb_text_add(text, ",");
        add_cell(text, axes, columns[i].type, (const char *)row + columns[i].offset);
    }
    sb_text_add(text, "\n");
}

// Cuts one field out of *p in place and steps behind its separator. Returns false on a
// quote that is never closed; *last: the field ended its line.
static bool cut_field(char **p, char **field, bool *last)
{
    char *from = *p, *to = *p;
    *field = to;
    if (*from == '"') {
        for (from++; *from != '"' || from[1] == '"'; from++) {
            if (*from == '"')
                from++;
            if (!*from)
                return false;
            *to++ = *from;
        }
        from++;
        if (!strchr(",\r\n", *from))
            return false;
    } else {
        while (*from && *from != ',' && *from != '\n')
            *to++ = *from++;
        if (to > *field && to[-1] == '\r')
            to--;
    }
    if (*from == '\r')
        from++;
    *last = *from != ',';
    *p = from + (*from != '\0');
    *to = '\0';
    return true;
}

static bool read_line(struct sb_csv *csv, char **p, char ***cells, int *count)
{
    char *field;
    bool last = false;
    int capacity = 0;
    char **list = NULL;
    *count = 0;
    while (!last) {
        if (!cut_field(p, &field, &last)) {
            free(list);
            return false;
        }
        list = sb_grow(list, *count, &capacity, sizeof *list);
        list[(*count)++] = field;
    }
    *cells = sb_arena_alloc(&csv->arena, (size_t)*count * sizeof **cells);
    memcpy(*cells, list, (size_t)*count * sizeof *list);
    free(list);
    return true;
}

bool sb_csv_read(const char *path, struct sb_csv *csv, struct sb_error *err)
{
    size_t size;
    char *data = sb_file_read(&csv->arena, path, (size_t)1 << 30, &size, err);
    if (!data)
        return false;
    char *end = strrchr(data, '\n');
    if (!end)
        return sb_fail(err, SB_BAD_INPUT, "%s: empty; a CSV with a header is wanted",
                       path);
    end[1] = '\0';

    char ***rows = NULL;
    int capacity = 0;
    bool good = true;
    for (char *p = data; *p && good;) {
        char **cells;
        int count;
        const int line = csv->row_count + 1;
        if (!read_line(csv, &p, &cells, &count)) {
            good = sb_fail(err, SB_BAD_INPUT,
                           "%s:%d: a quote that is not closed, or text behind one", path,
                           line);
            break;
        }
        if (csv->row_count == 0)
            csv->column_count = count;
        if (count != csv->column_count) {
            good = sb_fail(err, SB_BAD_INPUT, "%s:%d: %d fields; the header has %d", path,
                           line, count, csv->column_count);
            break;
        }
        rows = sb_grow(rows, csv->row_count, &capacity, sizeof *rows);
        rows[csv->row_count++] = cells;
    }
    if (csv->row_count) {
        csv->cell = sb_arena_alloc(&csv->arena, (size_t)csv->row_count * sizeof *rows);
        memcpy(csv->cell, rows, (size_t)csv->row_count * sizeof *rows);
    }
    free(rows);
    return good;
}

void sb_csv_free(struct sb_csv *csv)
{
    sb_arena_free(&csv->arena);
    *csv = (struct sb_csv){0};
}

int sb_csv_column(const struct sb_csv *csv, const char *name)
{
    for (int i = 0; i < csv->column_count; i++)
        if (strcmp(csv->cell[0][i], name) == 0)
            return i;
    return -1;
}

static bool get_cell(const char *text, enum sb_column_type type, void *cell)
{
    char *end;
    if (!*text || type == SB_AXES)
        return true;
    if (type == SB_TEXT) {
        *(const char **)cell = text;
        return true;
    }
    if (type == SB_REAL)
        *(double *)cell = strtod(text, &end);
    else
        *(int64_t *)cell = strtoll(text, &end, 10);
    return *end == '\0';
}

bool sb_csv_get(const struct sb_csv *csv, int line, const struct sb_column *columns,
                int count, void *row, struct sb_error *err)
{
    for (int i = 0; i < count; i++) {
        const int column = columns[i].name ? sb_csv_column(csv, columns[i].name) : -1;
        if (column < 0)
            continue;
        const char *text = csv->cell[line][column];
        if (!get_cell(text, columns[i].type, (char *)row + columns[i].offset))
            return sb_fail(err, SB_BAD_INPUT, "line %d: %s is \"%s\", a number is wanted",
                           line + 1, columns[i].name, text);
    }
    return true;
}
