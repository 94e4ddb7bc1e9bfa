// shadebench list: every table of the program, as text or JSON.
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/words.h"
#include "cases/case.h"
#include "cli/common.h"
#include "cli/table.h"
#include "export/export.h"
#include "gate/metric.h"
#include "results/gate_row.h"
#include "results/history_row.h"
#include "stats/gate.h"
#include "scene/scene.h"
#ifdef SB_HAVE_GL
#include "context/context.h"
#include "gl/timer.h"
#endif

// Everything listed is rows of words under titles.
struct listing {
    const char *title[12];
    int columns;
    json_t *rows; // array of arrays of strings
    int shown;    // of the columns, as text; 0: all. JSON has them all
};

static void add(struct listing *listing, const char *const *cell)
{
    json_t *row = json_array();
    for (int i = 0; i < listing->columns; i++)
        json_array_append_new(row, json_string(cell[i] ? cell[i] : ""));
    json_array_append_new(listing->rows, row);
}

static bool list_files(struct listing *listing, const struct sb_options *options,
                       const char *folder, struct sb_error *err)
{
    struct sb_arena arena = {0};
    int count = 0;
    const char *data = sb_data_dir(&arena, options->data, err);
    const char *path = data ? sb_path_join(&arena, data, folder) : NULL;
    bool good = path != NULL;
    char **names = good && sb_dir_exists(path)
                       ? sb_dir_list(&arena, path, ".yaml", &count, err)
                       : NULL;
    for (int i = 0; good && i < count; i++) {
        struct sb_suite suite = {0};
        const struct sb_suite_params params = {
            .path = sb_path_join(&arena, path, names[i]), .data_dir = data};
        good = sb_suite_load(&params, &suite, err);
        names[i][strlen(names[i]) - strlen(".yaml")] = '\0';
        const char *variants = sb_arena_printf(&arena, "%d", suite.entry_count);
        if (good)
            add(listing, (const char *const[]){names[i], variants, suite.about});
        sb_suite_free(&suite);
    }
    sb_arena_free(&arena);
    return good;
}

static bool list_suites(struct listing *listing, const struct sb_options *options,
                        struct sb_error *err)
{
    *listing = (struct listing){{"suite", "variants", "about"}, 3, listing->rows, 0};
    return list_files(listing, options, "bench", err);
}

static bool list_presets(struct listing *listing, const struct sb_options *options,
                         struct sb_error *err)
{
    *listing = (struct listing){{"preset", "variants", "about"}, 3, listing->rows, 0};
    return list_files(listing, options, "bench/presets", err);
}

static bool list_scenes(struct listing *listing, const struct sb_options *options,
                        struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"scene", "help"}, 2, listing->rows, 0};
    for (int i = 0; i < sb_scene_row_count; i++)
        add(listing, (const char *const[]){sb_scene_rows[i].name, sb_scene_rows[i].help});
    return true;
}

static void axis_values(const struct sb_axis *axis, struct sb_text *text,
                        struct sb_text *init)
{
    for (int v = 0; v < axis->value_count; v++)
        sb_text_printf(text, "%s%s%s", v ? " " : "", axis->values[v].name,
                       axis->values[v].flags & SB_TODO ? "*" : "");
    if (axis->values) {
        sb_text_add(init, axis->values[(int)axis->init].name);
        return;
    }
    char low[32], high[32];
    sb_text_printf(text, "%s..%s%s", sb_number_text(axis->min, low),
                   sb_number_text(axis->max, high), axis->flags & SB_TODO ? " *" : "");
    sb_text_number(init, axis->init);
}

static bool list_axes(struct listing *listing, const struct sb_options *options,
                      struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){
        {"axis", "kind", "default", "values (* not implemented yet)", "when", "help"},
        6,
        listing->rows,
        0};
    const struct sb_axes *axes = sb_axes_builtin();
    for (int a = 0; a < axes->count; a++) {
        const struct sb_axis *axis = &axes->row[a];
        struct sb_text values = {0}, init = {0};
        axis_values(axis, &values, &init);
        add(listing,
            (const char *const[]){axis->name, sb_axis_kind_names[axis->kind],
                                  sb_text_get(&init), sb_text_get(&values),
                                  axis->when[0] ? axis->when : axis->needs, axis->help});
        sb_text_free(&values);
        sb_text_free(&init);
    }
    return true;
}

static bool list_contexts(struct listing *listing, const struct sb_options *options,
                          struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"context", "help"}, 2, listing->rows, 0};
#ifdef SB_HAVE_GL
    for (int i = 0; sb_contexts[i]; i++)
        add(listing, (const char *const[]){sb_contexts[i]->name, sb_contexts[i]->help});
#endif
    add(listing, (const char *const[]){sb_runner_null.name, sb_runner_null.help});
    return true;
}

static bool list_timers(struct listing *listing, const struct sb_options *options,
                        struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"timer", "help"}, 2, listing->rows, 0};
#ifdef SB_HAVE_GL
    for (int i = 0; sb_timers[i]; i++)
        add(listing, (const char *const[]){sb_timers[i]->name, sb_timers[i]->help});
#endif
    return true;
}

static void add_columns(struct listing *listing, const char *file,
                        const struct sb_column *columns, int count)
{
    for (int i = 0; i < count; i++)
        add(listing,
            (const char *const[]){
                file, columns[i].name ? columns[i].name : "(every axis)",
                columns[i].name ? columns[i].help
                                : "value, empty where moot (shadebench list axes)"});
}

static bool list_columns(struct listing *listing, const struct sb_options *options,
                         struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"file", "column", "help"}, 3, listing->rows, 0};
    add_columns(listing, "summary.csv", sb_summary_columns, sb_summary_column_count);
    add_columns(listing, "samples.csv", sb_sample_columns, sb_sample_column_count);
    add_columns(listing, "cases.csv", sb_case_columns, sb_case_column_count);
    add_columns(listing, "gate.csv", sb_gate_columns, sb_gate_column_count);
    add_columns(listing, "pairs.csv", sb_pair_columns, sb_pair_column_count);
    add_columns(listing, "history", sb_history_columns, sb_history_column_count);
    return true;
}

static bool list_settings(struct listing *listing, const struct sb_options *options,
                          struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"setting", "default", "help"}, 3, listing->rows, 0};
    for (int i = 0; i < sb_measure_row_count; i++) {
        char init[32];
        add(listing, (const char *const[]){sb_measure_rows[i].name,
                                           sb_number_text(sb_measure_rows[i].init, init),
                                           sb_measure_rows[i].help});
    }
    return true;
}

static bool list_statuses(struct listing *listing, const struct sb_options *options,
                          struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"status", "exit code", "help"}, 3, listing->rows, 0};
    for (int i = 0; i < SB_STATUS_COUNT; i++) {
        char code[16];
        snprintf(code, sizeof code, "%d", sb_status_rows[i].exit_code);
        add(listing,
            (const char *const[]){sb_status_rows[i].word, code, sb_status_rows[i].help});
    }
    return true;
}

static bool list_cases(struct listing *listing, const struct sb_options *options,
                       struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"case", "family", "help", "formula", "given", "naive",
                                 "robust", "holds", "source"},
                                9,
                                listing->rows,
                                3};
    for (int f = 0; f < SB_CASE_FAMILIES; f++)
        for (int i = 0; i < sb_case_families[f]->count; i++) {
            const struct sb_case *it = &sb_case_families[f]->row[i];
            add(listing,
                (const char *const[]){it->id, sb_case_families[f]->name, it->help,
                                      it->formula, it->given, it->form[SB_CASE_NAIVE],
                                      it->form[SB_CASE_ROBUST], it->holds, it->source});
        }
    return true;
}

static bool list_formats(struct listing *listing, const struct sb_options *options,
                         struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"format", "help"}, 2, listing->rows, 0};
    for (int i = 0; i < sb_export_format_count; i++)
        add(listing,
            (const char *const[]){sb_export_formats[i].name, sb_export_formats[i].help});
    return true;
}

static bool list_verdicts(struct listing *listing, const struct sb_options *options,
                          struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"verdict", "help"}, 2, listing->rows, 0};
    for (int i = 0; i < SB_GATE_VERDICT_COUNT; i++)
        add(listing, (const char *const[]){sb_gate_verdict_rows[i].word,
                                           sb_gate_verdict_rows[i].help});
    return true;
}

static bool list_metrics(struct listing *listing, const struct sb_options *options,
                         struct sb_error *err)
{
    (void)options;
    (void)err;
    *listing = (struct listing){{"metric", "help"}, 2, listing->rows, 0};
    for (int i = 0; i < SB_METRIC_COUNT; i++)
        add(listing,
            (const char *const[]){sb_metric_rows[i].name, sb_metric_rows[i].help});
    return true;
}

static const struct {
    const char *name;
    bool (*fill)(struct listing *listing, const struct sb_options *options,
                 struct sb_error *err);
} lists[] = {
    {"suites", list_suites},   {"presets", list_presets},   {"scenes", list_scenes},
    {"axes", list_axes},       {"contexts", list_contexts}, {"timers", list_timers},
    {"columns", list_columns}, {"settings", list_settings}, {"statuses", list_statuses},
    {"cases", list_cases},     {"formats", list_formats},   {"verdicts", list_verdicts},
    {"metrics", list_metrics},
};
enum { LIST_COUNT = sizeof lists / sizeof *lists };

static void print_listing(const struct listing *listing)
{
    struct sb_table *table = sb_table_new();
    const int shown = listing->shown ? listing->shown : listing->columns;
    size_t r;
    const json_t *row;
    for (int i = 0; i < shown; i++)
        sb_table_column(table, listing->title[i], false);
    json_array_foreach(listing->rows, r, row)
    {
        for (int i = 0; i < shown; i++)
            sb_table_cell(table, json_string_value(json_array_get(row, (size_t)i)));
    }
    sb_table_print(table);
    sb_table_free(&table);
}

static json_t *listing_json(const struct listing *listing)
{
    json_t *list = json_array();
    size_t r, c;
    const json_t *row;
    json_t *cell;
    json_array_foreach(listing->rows, r, row)
    {
        json_t *object = json_object();
        json_array_foreach(row, c, cell) json_object_set(object, listing->title[c], cell);
        json_array_append_new(list, object);
    }
    return list;
}

int sb_cmd_list(const struct sb_options *options, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    struct sb_error err = {0};
    struct sb_text valid = {0};
    const char *names[LIST_COUNT];
    const char *word = options->word_count ? options->word[0] : "suites";
    int found = -1;
    for (int i = 0; i < LIST_COUNT; i++) {
        names[i] = lists[i].name;
        sb_text_printf(&valid, " %s", names[i]);
        if (strcmp(lists[i].name, word) == 0)
            found = i;
    }
    if (found < 0)
        sb_fail_unknown(&err, "", "list", word, names, LIST_COUNT);
    struct listing listing = {.rows = json_array()};
    const bool good = found >= 0 && lists[found].fill(&listing, options, &err);
    if (good && options->json) {
        sb_cli_print_json(listing_json(&listing));
    } else if (good) {
        print_listing(&listing);
        if (!options->word_count)
            printf("\nshadebench list WHAT, with WHAT one of:%s\n", sb_text_get(&valid));
    }
    json_decref(listing.rows);
    sb_text_free(&valid);
    return good ? 0 : sb_cli_fail(&err);
}
