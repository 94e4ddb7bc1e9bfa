// history show --wide: CSV with a line a commit and a column a variant, which Otava reads as
// `type: csv`. Its importer makes a float of every cell, so a commit at which a variant has no ratio
// is left out.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "base/mem.h"
#include "cli/history.h"
#include "results/csv.h"

struct wide {
    const struct sb_history_series *series; // of the analysis
    int *column;                            // places of those that go with the last row
    int count;
    bool scenes; // more than one
};

static const struct sb_history_series *series_of(const struct wide *wide, int column)
{
    return &wide->series[wide->column[column]];
}

static const struct sb_history_point *find_point(const struct sb_history_series *series,
                                                 const char *commit)
{
    for (int i = 0; i < series->point_count; i++)
        if (strcmp(series->point[i].commit, commit) == 0)
            return &series->point[i];
    return NULL;
}

static void choose(const struct sb_history_analysis *analysis, struct wide *wide)
{
    const struct sb_history_series *series = analysis->series;
    int last = 0;
    for (int i = 1; i < analysis->count; i++)
        if (series[i].like > series[last].like) // rows of one array, in its order
            last = i;
    for (int i = 0; i < analysis->count; i++) {
        if (!sb_history_together(series[i].like, series[last].like) ||
            series[i].point_count == 0)
            continue;
        wide->column[wide->count++] = i;
        wide->scenes |=
            strcmp(series[i].like->scene, series_of(wide, 0)->like->scene) != 0;
    }
}

static void add_header(const struct wide *wide, struct sb_text *text)
{
    struct sb_text name = {0};
    sb_text_add(text, "time,commit");
    for (int c = 0; c < wide->count; c++) {
        const struct sb_history_row *like = series_of(wide, c)->like;
        sb_text_clear(&name);
        sb_text_printf(&name, "%s%s%s", wide->scenes ? like->scene : "",
                       wide->scenes ? "/" : "", like->variant);
        sb_text_add(text, ",");
        sb_csv_field(text, name.data);
    }
    sb_text_add(text, "\n");
    sb_text_free(&name);
}

// False: a variant has no ratio at this commit.
static bool add_line(const struct wide *wide, const struct sb_history_point *commit,
                     struct sb_text *text)
{
    const size_t before = text->length;
    sb_text_printf(text, "%s,", commit->time);
    sb_csv_field(text, commit->commit);
    for (int c = 0; c < wide->count; c++) {
        const struct sb_history_point *point =
            find_point(series_of(wide, c), commit->commit);
        if (!point) {
            text->length = before;
            text->data[before] = '\0';
            return false;
        }
        sb_text_add(text, ",");
        sb_text_number(text, point->ratio);
    }
    sb_text_add(text, "\n");
    return true;
}

static bool in_earlier(const struct wide *wide, int column, const char *commit)
{
    for (int c = 0; c < column; c++)
        if (find_point(series_of(wide, c), commit))
            return true;
    return false;
}

void sb_history_print_wide(const struct sb_history_analysis *analysis)
{
    struct sb_text text = {0};
    struct wide wide = {.series = analysis->series};
    int left_out = 0;
    wide.column = sb_alloc(((size_t)analysis->count + 1) * sizeof *wide.column);
    choose(analysis, &wide);
    add_header(&wide, &text);
    // Lines that are whole are all found in the first column, and so are in its order.
    for (int c = 0; c < wide.count; c++) {
        const struct sb_history_series *series = series_of(&wide, c);
        for (int i = 0; i < series->point_count; i++)
            if (!in_earlier(&wide, c, series->point[i].commit))
                left_out += !add_line(&wide, &series->point[i], &text);
    }
    fputs(text.data, stdout);
    if (wide.count < analysis->count)
        sb_warn("%d series of another driver, metric or anchor than the last row's are "
                "left out",
                analysis->count - wide.count);
    if (left_out)
        sb_warn("%d commits at which a variant has no ratio are left out", left_out);
    free(wide.column);
    sb_text_free(&text);
}
