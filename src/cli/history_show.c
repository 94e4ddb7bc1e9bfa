// history show: the levels of each series, and where they change.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/history.h"
#include "cli/table.h"
#include "results/history_file.h"

static const double usual_tolerance = 0.02;
enum { USUAL_RECENT = 10 };

struct shown {
    const struct sb_options *options;
    const char *file;
    struct sb_history history;
    struct sb_history_params params;
    struct sb_history_analysis analysis;
};

static const char *text_of(const char *cell)
{
    return cell ? cell : "?";
}

// --- text --------------------------------------------------------------------------------------

enum { SPARKS = 32 };

// The last ratios, the lowest and the highest of them at the ends of the scale; where they hardly
// differ, in its middle.
static void add_sparks(const struct sb_history_series *series, double tolerance,
                       struct sb_text *text)
{
    static const char *const sparks[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    const int first = series->point_count > SPARKS ? series->point_count - SPARKS : 0;
    double lo = INFINITY, hi = 0;
    for (int i = first; i < series->point_count; i++) {
        lo = fmin(lo, series->point[i].ratio);
        hi = fmax(hi, series->point[i].ratio);
    }
    const double room = fmax(hi - lo, tolerance * lo);
    for (int i = first; i < series->point_count; i++) {
        const double share =
            room > 0 ? 0.5 + (series->point[i].ratio - (lo + hi) / 2) / room : 0.5;
        sb_text_add(text, sparks[(int)fmin(fmax(8 * share, 0), 7)]);
    }
}

static void add_levels(const struct sb_history_series *series, struct sb_text *text)
{
    for (int s = 0; s < series->segment_count; s++)
        sb_text_printf(text, "%s%.4f", s ? " > " : "", series->segment[s].level.point);
}

static void add_series(struct sb_table *table, const struct sb_history_series *series,
                       double tolerance)
{
    struct sb_text text = {0};
    const int n = series->point_count;
    sb_table_cell(table, series->like->scene);
    sb_table_cell(table, series->like->variant);
    sb_table_cellf(table, "%d", n);
    sb_table_real(table, "%.4f", n ? series->point[0].ratio : NAN);
    sb_table_real(table, "%.4f", n ? series->point[n - 1].ratio : NAN);
    add_levels(series, &text);
    sb_table_cell(table, sb_text_get(&text));
    if (n)
        sb_table_cellf(table, "%+.1f %%%s", 100 * series->creep,
                       series->crept ? " !" : "");
    else
        sb_table_cell(table, NULL);
    sb_text_clear(&text);
    add_sparks(series, tolerance, &text);
    sb_table_cell(table, sb_text_get(&text));
    sb_text_free(&text);
}

static void print_change(const struct sb_history_series *series, int s)
{
    const struct sb_segment *segment = &series->segment[s];
    const struct sb_history_point *after = &series->point[segment->start],
                                  *before = after - 1;
    printf("%s %s: %+.1f %% between %.12s (%.10s) and %.12s (%.10s), now %.4f, %+.1f %% "
           "since the first level\n",
           series->like->scene, series->like->variant, 100 * (segment->step - 1),
           before->commit, before->time, after->commit, after->time, segment->level.point,
           100 * (segment->since_first - 1));
}

static void print_notes(const struct sb_history_series *series)
{
    if (series->failed)
        printf("%s %s: %d rows have no ratio\n", series->like->scene,
               series->like->variant, series->failed);
    if (series->unread)
        printf("%s %s: only the last %d commits are read\n", series->like->scene,
               series->like->variant, SB_CHANGE_VALUES_MAX);
}

// The series that go together with number `first`, which none before it does.
static void print_together(const struct shown *shown, int first)
{
    const struct sb_history_analysis *analysis = &shown->analysis;
    const struct sb_history_row *like = analysis->series[first].like;
    static const char *const titles[] = {"scene", "variant", "commits", "first",
                                         "last",  "levels",  "creep",   ""};
    struct sb_table *table = sb_table_new();
    printf("%s%s on %s, %s, threads %s, against the anchor %s\n", first ? "\n" : "",
           text_of(like->metric), text_of(like->renderer), text_of(like->version),
           like->threads ? like->threads : "-", text_of(like->anchor));
    for (int i = 0; i < 8; i++)
        sb_table_column(table, titles[i], i >= 2 && i != 5 && i != 7);
    for (int i = first; i < analysis->count; i++)
        if (sb_history_together(like, analysis->series[i].like))
            add_series(table, &analysis->series[i], shown->params.tolerance);
    sb_table_print(table);
    sb_table_free(&table);
    for (int i = first; i < analysis->count; i++) {
        const struct sb_history_series *series = &analysis->series[i];
        if (!sb_history_together(like, series->like))
            continue;
        for (int s = 1; s < series->segment_count; s++)
            print_change(series, s);
        print_notes(series);
    }
}

static bool is_first_together(const struct sb_history_analysis *analysis, int i)
{
    for (int k = 0; k < i; k++)
        if (sb_history_together(analysis->series[k].like, analysis->series[i].like))
            return false;
    return true;
}

static void print_text(const struct shown *shown)
{
    const struct sb_history_analysis *analysis = &shown->analysis;
    int crept = 0, recent = 0;
    for (int i = 0; i < analysis->count; i++) {
        crept += analysis->series[i].crept;
        recent += analysis->series[i].recent;
        if (is_first_together(analysis, i))
            print_together(shown, i);
    }
    printf("\n%d of %d series are over their first level by more than %g %%; %d went up "
           "within the last %d commits\n",
           crept, analysis->count, 100 * shown->params.tolerance, recent,
           shown->params.recent);
}

// --- JSON --------------------------------------------------------------------------------------

static json_t *text_json(const char *text)
{
    return text ? json_string(text) : json_null();
}

static json_t *number_json(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *points_json(const struct sb_history_series *series)
{
    json_t *list = json_array();
    for (int i = 0; i < series->point_count; i++) {
        const struct sb_history_point *point = &series->point[i];
        json_array_append_new(list, json_pack("{sssssfsi}", "commit", point->commit,
                                              "time", point->time, "ratio", point->ratio,
                                              "rows", point->rows));
    }
    return list;
}

static json_t *segments_json(const struct sb_history_series *series)
{
    json_t *list = json_array();
    for (int s = 0; s < series->segment_count; s++) {
        const struct sb_segment *segment = &series->segment[s];
        const struct sb_history_point *first = &series->point[segment->start];
        json_t *object = json_pack("{sssisfsfsf}", "commit", first->commit, "commits",
                                   segment->n, "level", segment->level.point, "step",
                                   segment->step, "since_first", segment->since_first);
        json_object_set_new(object, "before",
                            s ? json_string(first[-1].commit) : json_null());
        json_object_set_new(object, "level_lo", number_json(segment->level.lo));
        json_object_set_new(object, "level_hi", number_json(segment->level.hi));
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *series_json(const struct sb_history_series *series)
{
    const struct sb_history_row *like = series->like;
    const struct {
        const char *name, *value;
    } key[] = {
        {"scene", like->scene},       {"variant", like->variant},
        {"metric", like->metric},     {"anchor", like->anchor},
        {"renderer", like->renderer}, {"version", like->version},
        {"threads", like->threads},
    };
    json_t *object = json_object();
    for (size_t i = 0; i < sizeof key / sizeof *key; i++)
        json_object_set_new(object, key[i].name, text_json(key[i].value));
    json_object_set_new(object, "points", points_json(series));
    json_object_set_new(object, "segments", segments_json(series));
    json_object_set_new(object, "creep", number_json(series->creep));
    json_object_set_new(object, "crept", json_boolean(series->crept));
    json_object_set_new(object, "recent", json_boolean(series->recent));
    json_object_set_new(object, "failed", json_integer(series->failed));
    return object;
}

static void print_json(const struct shown *shown)
{
    json_t *list = json_array();
    for (int i = 0; i < shown->analysis.count; i++)
        json_array_append_new(list, series_json(&shown->analysis.series[i]));
    sb_cli_print_json(json_pack("{sssfsiso}", "file", shown->file, "tolerance",
                                shown->params.tolerance, "recent", shown->params.recent,
                                "series", list));
}

// --- the whole ---------------------------------------------------------------------------------

static bool read_options(struct shown *shown, struct sb_error *err)
{
    const struct sb_options *options = shown->options;
    double recent = USUAL_RECENT;
    if (options->word_count > 1)
        return sb_fail(err, SB_USAGE,
                       "history show takes no word, but --variant \"%s\" may be meant",
                       options->word[1]);
    if (options->wide && (options->json || options->check))
        return sb_fail(err, SB_USAGE, "--wide or %s, not both",
                       options->json ? "--json" : "--check");
    if (options->recent && (!sb_parse_number(options->recent, &recent) || recent < 0 ||
                            recent > 1e6 || recent != floor(recent)))
        return sb_fail(err, SB_USAGE, "--recent %s: a whole number from 0 is wanted",
                       options->recent);
    shown->params.recent = (int)recent;
    shown->params.tolerance = usual_tolerance;
    shown->params.pattern = options->variant;
    return !options->tolerance || sb_cli_read_share("--tolerance", options->tolerance,
                                                    &shown->params.tolerance, err);
}

static bool analyse(struct shown *shown, struct sb_error *err)
{
    if (!read_options(shown, err) || !sb_history_read(shown->file, &shown->history, err))
        return false;
    shown->params.row = shown->history.row;
    shown->params.count = shown->history.count;
    sb_history_analyse(&shown->params, &shown->analysis);
    if (shown->analysis.count == 0 && shown->history.count > 0)
        return sb_fail(err, SB_BAD_INPUT, "%s: no variant matches \"%s\"", shown->file,
                       shown->params.pattern);
    return true;
}

static int check(const struct shown *shown)
{
    for (int i = 0; i < shown->analysis.count; i++)
        if (shown->analysis.series[i].crept || shown->analysis.series[i].recent)
            return 1;
    return 0;
}

int sb_history_show(const struct sb_options *options)
{
    struct sb_error err = {0};
    struct shown shown = {.options = options,
                          .file = options->file ? options->file : SB_HISTORY_FILE};
    int code = 0;
    if (!analyse(&shown, &err))
        code = sb_cli_fail(&err);
    else if (options->json)
        print_json(&shown);
    else if (options->wide)
        sb_history_print_wide(&shown.analysis);
    else if (shown.analysis.count == 0)
        printf("%s: no rows yet\n", shown.file);
    else
        print_text(&shown);
    if (code == 0 && options->check)
        code = check(&shown);
    sb_history_analysis_free(&shown.analysis);
    sb_history_free(&shown.history);
    return code;
}
