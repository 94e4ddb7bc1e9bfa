// shadebench fit: the cost model of a run. Nothing is measured.
#include "cli/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/words.h"
#include "scene/lights.h"

int sb_fit_budgets(const struct sb_fit_report *report, const struct sb_fit_group *group,
                   double *ms)
{
    enum { OWN = 6 };
    double least = INFINITY, most = 0;
    if (report->ms_count > 0) {
        memcpy(ms, report->ms, (size_t)report->ms_count * sizeof *ms);
        return report->ms_count;
    }
    for (int i = 0; i < group->rows; i++) {
        least = fmin(least, group->row[i]->median_ms);
        most = fmax(most, group->row[i]->median_ms);
    }
    const int last = (int)ceil(log2(most));
    int first = (int)ceil(log2(least)), count = 0;
    if (first < last - (OWN - 1))
        first = last - (OWN - 1);
    for (int power = first; power <= last; power++)
        ms[count++] = ldexp(1, power);
    return count;
}

static bool is_counted(int axis)
{
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        if (sb_light_structs[t].axis == axis)
            return true;
    return false;
}

// Of several rows one says of an axis what those say for which it is not moot.
static void add_value(const struct sb_axes *axes, const struct sb_row *const *row,
                      int rows, int axis, struct sb_text *text)
{
    for (int i = 0; i < rows; i++)
        if (!sb_variant_moot(axes, row[i]->axes, axis)) {
            sb_compare_add_axis(axes, row[i], axis, text);
            return;
        }
}

void sb_fit_heading(const struct sb_fit_report *report, const struct sb_fit_group *group,
                    struct sb_text *text)
{
    const struct sb_axes *axes = report->compared->axes;
    struct sb_text own = {0}, other = {0};
    sb_text_add(text, group->row[0]->scene);
    for (int a = 0; a < axes->count; a++) {
        bool same = true;
        sb_text_clear(&own);
        add_value(axes, group->row, group->rows, a, &own);
        for (int g = 0; g < report->fit.count; g++) {
            sb_text_clear(&other);
            add_value(axes, report->fit.group[g].row, report->fit.group[g].rows, a,
                      &other);
            same &=
                other.length == 0 || strcmp(sb_text_get(&own), sb_text_get(&other)) == 0;
        }
        if (!same && !is_counted(a))
            sb_text_add(text, sb_text_get(&own));
    }
    sb_compare_add_driver(report->compared, group->row[0], text);
    sb_text_free(&own);
    sb_text_free(&other);
}

void sb_fit_series_heading(const struct sb_fit_report *report,
                           const struct sb_crossing_series *series, struct sb_text *text)
{
    const struct sb_axes *axes = report->compared->axes;
    const struct sb_row *row = series->pair->a;
    sb_text_add(text, row->scene);
    for (int a = 0; a < axes->count; a++)
        if (a != series->axis && !(axes->row[a].flags & SB_TRUTH) &&
            sb_variant_given(row->axes, a) && sb_compare_varies(report->compared, a))
            sb_compare_add_axis(axes, row, a, text);
    sb_compare_add_driver(report->compared, row, text);
}

void sb_fit_mix_text(const struct sb_fit_report *report, const struct sb_fit_group *group,
                     const struct sb_row *row, struct sb_text *text)
{
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++) {
        const int axis = sb_light_structs[t].axis;
        if (row->axes->value[axis] > group->lowest[t])
            sb_text_printf(text, "%s%s=%g", text->length ? " " : "",
                           report->compared->axes->row[axis].name,
                           row->axes->value[axis]);
    }
}

// --- the command --------------------------------------------------------------------------

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool read_budgets(const char *text, struct sb_fit_report *report,
                         struct sb_arena *arena, struct sb_error *err)
{
    char *rest = text ? sb_arena_strdup(arena, text) : NULL;
    while (rest) {
        char *const word = rest;
        double ms;
        rest = strchr(word, ',');
        if (rest)
            *rest++ = '\0';
        if (!sb_parse_number(word, &ms) || !(ms > 0) || !isfinite(ms))
            return sb_fail(
                err, SB_USAGE,
                "--ms %s: \"%s\" is no time; milliseconds above 0 are wanted, such "
                "as --ms 4,8,16",
                text, word);
        if (report->ms_count == SB_BUDGETS_MAX)
            return sb_fail(err, SB_USAGE, "--ms %s: more than %d times", text,
                           SB_BUDGETS_MAX);
        report->ms[report->ms_count++] = ms;
    }
    qsort(report->ms, (size_t)report->ms_count, sizeof *report->ms, ascending);
    return true;
}

static bool check_words(const struct sb_options *options, struct sb_error *err)
{
    if (options->word_count == 0)
        return sb_fail(
            err, SB_USAGE,
            "fit wants a results folder or its summary.csv; shadebench run fit "
            "makes one");
    if (options->word_count > 1)
        return sb_fail(err, SB_USAGE, "fit takes one run; \"%s\" is one too many",
                       options->word[1]);
    return true;
}

static bool fit_rows(struct sb_fit_report *report, struct sb_error *err)
{
    const struct sb_compared *compared = report->compared;
    int axis[SB_LIGHT_TYPE_COUNT];
    for (int t = 0; t < SB_LIGHT_TYPE_COUNT; t++)
        axis[t] = sb_light_structs[t].axis;
    const struct sb_fit_params params = {
        .axes = compared->axes,
        .row = compared->rows.row,
        .count = compared->rows.count,
        .count_axis = axis,
        .count_axes = SB_LIGHT_TYPE_COUNT,
    };
    sb_fit_make(&params, &report->fit);
    sb_crossings_find(compared->axes, params.row, params.count, &report->crossings);
    if (report->fit.count > 0 || report->crossings.count > 0)
        return true;
    return sb_fail(
        err, SB_BAD_INPUT,
        "%s: of %d rows with a valid time no %d differ in the count of one type of "
        "light alone, and no stages stand at two densities of triangles; shadebench "
        "run fit measures such",
        compared->path, params.count - report->fit.without_time, SB_FIT_COUNTS_MIN);
}

int sb_cmd_fit(const struct sb_options *options, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_compared compared = {0};
    struct sb_fit_report report = {.compared = &compared};
    int code = 0;
    if (!check_words(options, &err) ||
        !read_budgets(options->ms, &report, &arena, &err) ||
        !sb_results_load(options, options->word[0], &compared, &arena, &err) ||
        !fit_rows(&report, &err))
        code = sb_cli_fail(&err);
    else if (options->json)
        sb_cli_print_json(sb_fit_json(&report));
    else
        sb_fit_print(&report);
    sb_crossings_free(&report.crossings);
    sb_fit_free(&report.fit);
    sb_results_free(&compared);
    sb_arena_free(&arena);
    return code;
}
