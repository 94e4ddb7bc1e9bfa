#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/text.h"
#include "cli/table.h"

struct column {
    const char *title;
    bool right;
    int width;
};

struct sb_table {
    struct column *column;
    int column_count, column_capacity;
    const char **cell;
    int cell_count, cell_capacity;
    struct sb_arena arena;
};

struct sb_table *sb_table_new(void)
{
    return sb_alloc(sizeof(struct sb_table));
}

void sb_table_free(struct sb_table **table)
{
    if (!*table)
        return;
    free((*table)->column);
    free((*table)->cell);
    sb_arena_free(&(*table)->arena);
    free(*table);
    *table = NULL;
}

void sb_table_column(struct sb_table *table, const char *title, bool right)
{
    table->column = sb_grow(table->column, table->column_count, &table->column_capacity,
                            sizeof *table->column);
    table->column[table->column_count++] = (struct column){
        sb_arena_strdup(&table->arena, title), right, sb_text_width(title)};
}

void sb_table_cell(struct sb_table *table, const char *text)
{
    text = sb_arena_strdup(&table->arena, text ? text : "");
    struct column *column = &table->column[table->cell_count % table->column_count];
    if (sb_text_width(text) > column->width)
        column->width = sb_text_width(text);
    table->cell = sb_grow(table->cell, table->cell_count, &table->cell_capacity,
                          sizeof *table->cell);
    table->cell[table->cell_count++] = text;
}

void sb_table_cellf(struct sb_table *table, const char *format, ...)
{
    struct sb_text text = {0};
    va_list args;
    va_start(args, format);
    sb_text_vprintf(&text, format, args);
    va_end(args);
    sb_table_cell(table, sb_text_get(&text));
    sb_text_free(&text);
}

void sb_table_real(struct sb_table *table, const char *format, double value)
{
    char text[64] = "";
    if (!isnan(value))
        snprintf(text, sizeof text, format, value);
    sb_table_cell(table, text);
}

static void print_cell(const struct sb_table *table, int index, const char *text)
{
    const struct column *column = &table->column[index];
    const int padding = column->width - sb_text_width(text);
    const bool last = index == table->column_count - 1;
    printf("%s%*s%s%*s", index ? "  " : "", column->right ? padding : 0, "", text,
           column->right || last ? 0 : padding, "");
    if (last)
        printf("\n");
}

void sb_table_print(const struct sb_table *table)
{
    for (int i = 0; i < table->column_count; i++)
        print_cell(table, i, table->column[i].title);
    for (int i = 0; i < table->cell_count; i++)
        print_cell(table, i % table->column_count, table->cell[i]);
}
