#include "analyse/history.h"

#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

static bool same(const char *a, const char *b)
{
    return strcmp(a ? a : "", b ? b : "") == 0;
}

bool sb_history_together(const struct sb_history_row *a, const struct sb_history_row *b)
{
    return same(a->metric, b->metric) && same(a->anchor, b->anchor) &&
           same(a->renderer, b->renderer) && same(a->version, b->version) &&
           same(a->threads, b->threads);
}

static bool in_series(const struct sb_history_row *a, const struct sb_history_row *b)
{
    return same(a->variant, b->variant) && same(a->scene, b->scene) &&
           sb_history_together(a, b);
}

static bool is_wanted(const struct sb_history_row *row, const char *pattern)
{
    if (!pattern || fnmatch(pattern, row->variant, 0) == 0)
        return true;
    struct sb_arena arena = {0};
    const bool wanted =
        fnmatch(pattern, sb_arena_printf(&arena, "%s/%s", row->scene, row->variant), 0) ==
        0;
    sb_arena_free(&arena);
    return wanted;
}

// --- points --------------------------------------------------------------------------------------

struct placed { // a row with its place in the file
    const struct sb_history_row *row;
    int place;
    const char *first; // time of the first row of its commit …
    int first_place;   // … and where that stands
};

static int compare_first(const struct placed *a, const struct placed *b)
{
    const int by_time = strcmp(a->first, b->first);
    return by_time
               ? by_time
               : (a->first_place > b->first_place) - (a->first_place < b->first_place);
}

static int by_commit(const void *x, const void *y)
{
    const struct placed *a = x, *b = y;
    const int commits = strcmp(a->row->commit, b->row->commit);
    const int times = commits ? commits : strcmp(a->row->time, b->row->time);
    return times ? times : (a->place > b->place) - (a->place < b->place);
}

// By the time of the commit's first row; commits of one time in the order of the file.
static int by_first(const void *x, const void *y)
{
    const struct placed *a = x, *b = y;
    const int order = compare_first(a, b);
    return order ? order : (a->place > b->place) - (a->place < b->place);
}

// Rows in the order of their commits, those of a commit side by side.
static void sort_rows(struct placed *row, int count)
{
    qsort(row, (size_t)count, sizeof *row, by_commit);
    for (int i = 0; i < count; i++) {
        const bool more = i > 0 && same(row[i].row->commit, row[i - 1].row->commit);
        row[i].first = more ? row[i - 1].first : row[i].row->time;
        row[i].first_place = more ? row[i - 1].first_place : row[i].place;
    }
    qsort(row, (size_t)count, sizeof *row, by_first);
}

static void make_points(struct sb_history_series *series, const struct placed *row)
{
    double *ratio = sb_alloc(((size_t)series->rows + 1) * sizeof *ratio);
    series->point = sb_alloc(((size_t)series->rows + 1) * sizeof *series->point);
    for (int i = 0; i < series->rows;) {
        struct sb_history_point *point = &series->point[series->point_count++];
        *point =
            (struct sb_history_point){.commit = row[i].row->commit, .time = row[i].first};
        for (; i < series->rows && same(row[i].row->commit, point->commit); i++)
            ratio[point->rows++] = row[i].row->ratio;
        sb_sort_doubles(ratio, point->rows);
        point->ratio = sb_median(ratio, point->rows);
    }
    free(ratio);
    if (series->point_count > SB_CHANGE_VALUES_MAX) {
        series->unread = series->point_count - SB_CHANGE_VALUES_MAX;
        series->point_count = SB_CHANGE_VALUES_MAX;
        memmove(series->point, series->point + series->unread,
                SB_CHANGE_VALUES_MAX * sizeof *series->point);
    }
}

// --- levels --------------------------------------------------------------------------------------

static void find_levels(struct sb_history_series *series,
                        const struct sb_history_params *params)
{
    struct sb_change_rule rule = sb_change_rule_default();
    const int n = series->point_count;
    rule.min_magnitude = params->tolerance;
    series->creep = NAN;
    if (n == 0)
        return;
    double *value = sb_alloc((size_t)n * sizeof *value);
    double *scratch = sb_alloc((size_t)sb_change_points_room(n) * sizeof *scratch);
    series->segment =
        sb_alloc((size_t)sb_segments_max(n, &rule) * sizeof *series->segment);
    for (int i = 0; i < n; i++)
        value[i] = series->point[i].ratio;
    series->segment_count = sb_change_points(value, n, &rule, scratch, series->segment);
    series->creep = series->segment[series->segment_count - 1].since_first - 1;
    series->crept = series->creep > params->tolerance;
    for (int s = 1; s < series->segment_count; s++)
        series->recent |=
            series->segment[s].step > 1 && series->segment[s].start >= n - params->recent;
    free(scratch);
    free(value);
}

// --- series --------------------------------------------------------------------------------------

// Of the row's series the number; rows are many and series few.
static int find_series(struct sb_history_analysis *analysis,
                       const struct sb_history_row *row, int *capacity)
{
    for (int i = 0; i < analysis->count; i++)
        if (in_series(analysis->series[i].like, row))
            return i;
    analysis->series =
        sb_grow(analysis->series, analysis->count, capacity, sizeof *analysis->series);
    analysis->series[analysis->count] = (struct sb_history_series){.like = row};
    return analysis->count++;
}

void sb_history_analyse(const struct sb_history_params *params,
                        struct sb_history_analysis *analysis)
{
    int capacity = 0;
    int *number = sb_alloc(((size_t)params->count + 1) * sizeof *number);
    struct placed *row = sb_alloc(((size_t)params->count + 1) * sizeof *row);
    for (int i = 0; i < params->count; i++) {
        const struct sb_history_row *one = &params->row[i];
        number[i] = -1;
        if (!is_wanted(one, params->pattern))
            continue;
        const int s = find_series(analysis, one, &capacity);
        struct sb_history_series *series = &analysis->series[s];
        series->like = one;
        if (isnan(one->ratio)) {
            series->failed++;
            continue;
        }
        number[i] = s;
        series->rows++;
    }
    for (int s = 0; s < analysis->count; s++) {
        int count = 0;
        for (int i = 0; i < params->count; i++)
            if (number[i] == s)
                row[count++] = (struct placed){.row = &params->row[i], .place = i};
        sort_rows(row, count);
        make_points(&analysis->series[s], row);
        find_levels(&analysis->series[s], params);
    }
    free(row);
    free(number);
}

void sb_history_analysis_free(struct sb_history_analysis *analysis)
{
    for (int s = 0; s < analysis->count; s++) {
        free(analysis->series[s].point);
        free(analysis->series[s].segment);
    }
    free(analysis->series);
    *analysis = (struct sb_history_analysis){0};
}
