// compare --pareto: the rows of a run by time, each with its mark, a table for each group of
// rows that may be ranked against each other.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/pareto.h"
#include "cli/compare.h"
#include "cli/report.h"
#include "scene/scene.h"

static const char rules[] = "front: no other row of its group is faster by its whole "
                            "interval and no worse in largest\n"
                            "error, p99.9, FLIP and non-finite values. A group has one "
                            "scene, target, platform and timer.\n";

// A group of rows, sorted by time; the last one holds those that are not ranked.
struct group {
    struct sb_row *row;
    int count;
};

static int by_time(const void *a, const void *b)
{
    const struct sb_row *x = a, *y = b;
    if (isnan(x->median_ms) || isnan(y->median_ms))
        return isnan(x->median_ms) - isnan(y->median_ms);
    if (x->median_ms != y->median_ms)
        return x->median_ms < y->median_ms ? -1 : 1;
    return strcmp(x->variant, y->variant);
}

// Fills row[0 .. rows->count - 1] group after group; returns the number of groups.
static int make_groups(const struct sb_pareto_params *params, struct sb_row *row,
                       struct group *group)
{
    bool *taken = sb_alloc((size_t)params->count + 1);
    int groups = 0, filled = 0;
    for (int i = 0; i < params->count; i++) {
        const struct sb_row *first = &params->row[i];
        if (taken[i])
            continue;
        group[groups].row = row + filled;
        for (int j = i; j < params->count; j++) {
            const struct sb_row *other = &params->row[j];
            const bool together =
                !first->front
                    ? !other->front
                    : other->front && sb_pareto_comparable(params, first, other);
            if (taken[j] || !together)
                continue;
            taken[j] = true;
            row[filled++] = *other;
            group[groups].count++;
        }
        qsort(group[groups].row, (size_t)group[groups].count, sizeof *row, by_time);
        groups++;
    }
    free(taken);
    // What is not ranked comes last.
    for (int i = 0; i + 1 < groups; i++)
        if (!group[i].row->front) {
            const struct group last = group[i];
            memmove(&group[i], &group[i + 1], (size_t)(groups - 1 - i) * sizeof *group);
            group[groups - 1] = last;
            break;
        }
    return groups;
}

// The scene, and those of the group's axes that are others in other groups.
static void add_heading(const struct sb_compared *compared, const struct group *group,
                        struct sb_text *text)
{
    const struct sb_axes *axes = compared->axes;
    if (!group->row->front) {
        sb_text_add(text, "not ranked: no interval, no error, a status that fails the "
                          "run, or emulated");
        return;
    }
    sb_text_add(text, group->row->scene);
    for (int a = 0; a < axes->count; a++) {
        bool same = true;
        for (int i = 1; i < group->count; i++)
            same &= group->row[i].axes->value[a] == group->row->axes->value[a];
        if (same && sb_pareto_keeps_apart(&axes->row[a]) &&
            sb_compare_varies(compared, a))
            sb_compare_add_axis(axes, group->row, a, text);
    }
    sb_compare_add_driver(compared, group->row, text);
}

static void print_group(const struct sb_compared *compared, const struct group *group)
{
    struct sb_text text = {0};
    struct sb_table *table = sb_table_new();
    struct sb_keys keys;
    const bool ranked = group->row->front != NULL;
    add_heading(compared, group, &text);
    printf("\n%s\n", sb_text_get(&text));
    sb_keys_make(&keys, compared->axes, group->row, group->count);
    if (!ranked)
        keys.id = true; // their axes may have nothing in common
    sb_keys_columns(&keys, table);
    static const char *const titles[] = {"median ms", "±",    "max err",   "of 255",
                                         "p99.9",     "FLIP", "non-finite"};
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++)
        sb_table_column(table, titles[i], true);
    sb_table_column(table, ranked ? "front" : "status", false);
    for (int i = 0; i < group->count; i++) {
        const struct sb_row *row = &group->row[i];
        sb_keys_cells(&keys, table, row);
        sb_report_level(table, row);
        sb_table_real(table, "%.2g", row->max_err);
        sb_table_real(table, "%.2g", 255 * row->max_err);
        sb_table_real(table, "%.2g", row->p999_err);
        sb_table_real(table, "%.2g", row->flip_mean);
        sb_table_real(table, "%.0f",
                      row->nonfinite == SB_NO_COUNT ? NAN : (double)row->nonfinite);
        sb_text_clear(&text);
        sb_report_mark(&keys, row, &text);
        sb_table_cell(table, ranked ? sb_text_get(&text) : row->status);
    }
    sb_table_print(table);
    sb_table_free(&table);
    sb_text_free(&text);
}

static json_t *groups_json(const struct sb_compared *compared, const struct group *group,
                           int groups)
{
    json_t *list = json_array(), *rest = json_array();
    for (int i = 0; i < groups; i++) {
        json_t *rows = sb_report_json(compared->axes, group[i].row, group[i].count);
        if (group[i].row->front) {
            json_array_append_new(
                list, json_pack("{ssso}", "scene", group[i].row->scene, "rows", rows));
        } else {
            json_decref(rest);
            rest = rows;
        }
    }
    return json_pack("{sssoso}", "file", compared->path, "groups", list, "not_ranked",
                     rest);
}

int sb_compare_pareto(const struct sb_options *options, struct sb_compared *compared)
{
    const struct sb_pareto_params params = {
        .row = compared->rows.row,
        .count = compared->rows.count,
        .axes = compared->axes,
        .analytic = sb_scene_analytic,
    };
    struct sb_row *row = sb_alloc((size_t)params.count * sizeof *row);
    struct group *group = sb_alloc((size_t)params.count * sizeof *group);
    sb_pareto_mark(&params);
    const int groups = make_groups(&params, row, group);
    if (options->json) {
        sb_cli_print_json(groups_json(compared, group, groups));
    } else {
        printf("%s", rules);
        for (int i = 0; i < groups; i++)
            print_group(compared, &group[i]);
    }
    free(group);
    free(row);
    return 0;
}
