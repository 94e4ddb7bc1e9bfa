// compare A B: the rows of two runs side by side.
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/runs.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/compare.h"
#include "cli/report.h"
#include "results/store.h"

static const double usual_tolerance = 0.02;

// What run.json says that a row does not, and that rows are refused for. Levels depend on all of it.
static const struct {
    const char *object, *key, *name;
} fact_rows[] = {
    {"machine", "cpu", "cpu"},
    {"machine", "cpus", "processors"},
    {"environment", "LP_NUM_THREADS", "LP_NUM_THREADS"},
};
enum { FACTS = sizeof fact_rows / sizeof *fact_rows };

struct run {
    struct sb_compared compared;
    struct sb_run_fact fact[FACTS];
    int fact_count;
};

struct comparison {
    const struct sb_options *options;
    struct run a, b;
    double tolerance;
    struct sb_runs runs;
    struct sb_arena arena;
};

// --- input ----------------------------------------------------------------------------------

static const char *fact_text(const json_t *process, int i, struct sb_arena *arena)
{
    const json_t *value =
        json_object_get(json_object_get(process, fact_rows[i].object), fact_rows[i].key);
    if (json_is_integer(value))
        return sb_arena_printf(arena, "%" PRId64, (int64_t)json_integer_value(value));
    return sb_arena_strdup(arena, json_is_string(value) ? json_string_value(value) : "");
}

// What one platform was given, and another was not, the axes of the rows say.
static bool is_said(const json_t *run, int i)
{
    return !json_object_get(run, "platforms") ||
           strcmp(fact_rows[i].object, "machine") == 0;
}

// Of all processes: "one" or, where they differ, which is said, "one and other".
static const char *load_fact(const struct run *run, const json_t *json, int i,
                             struct sb_arena *arena)
{
    const json_t *processes = json_object_get(json, "processes"), *process;
    const char **seen =
        sb_arena_alloc(arena, (json_array_size(processes) + 1) * sizeof *seen);
    int count = 0;
    struct sb_text all = {0};
    size_t p;
    json_array_foreach(processes, p, process)
    {
        int at = 0;
        const char *text = fact_text(process, i, arena);
        while (at < count && strcmp(seen[at], text) != 0)
            at++;
        if (at == count)
            seen[count++] = text;
    }
    for (int k = 0; k < count; k++)
        sb_text_printf(&all, "%s%s", k ? " and " : "",
                       *seen[k] || count == 1 ? seen[k] : "none");
    const char *text = sb_arena_strdup(arena, sb_text_get(&all));
    sb_text_free(&all);
    if (count > 1 && is_said(json, i))
        sb_warn("%s: its processes differ in %s: %s", run->compared.path,
                fact_rows[i].name, text);
    return text;
}

// A folder of which only summary.csv is left has no facts.
static void load_facts(struct run *run, struct sb_arena *arena)
{
    struct sb_error ignored;
    json_t *json = sb_store_read_run(run->compared.folder, &ignored);
    const size_t processes = json_array_size(json_object_get(json, "processes"));
    for (int i = 0; processes > 0 && i < FACTS; i++)
        run->fact[run->fact_count++] =
            (struct sb_run_fact){fact_rows[i].name, load_fact(run, json, i, arena)};
    json_decref(json);
}

static struct sb_run_side side_of(const struct run *run)
{
    return (struct sb_run_side){
        .axes = run->compared.axes,
        .row = run->compared.rows.row,
        .count = run->compared.rows.count,
        .fact = run->fact,
        .fact_count = run->fact_count,
    };
}

static bool load(struct comparison *all, struct sb_error *err)
{
    const struct sb_options *options = all->options;
    all->tolerance = usual_tolerance;
    if ((options->tolerance &&
         !sb_cli_read_share("--tolerance", options->tolerance, &all->tolerance, err)) ||
        !sb_results_load(options, options->word[0], &all->a.compared, &all->arena, err) ||
        !sb_results_load(options, options->word[1], &all->b.compared, &all->arena, err))
        return false;
    load_facts(&all->a, &all->arena);
    load_facts(&all->b, &all->arena);
    return true;
}

static bool fail_nothing(const struct comparison *all, struct sb_error *err)
{
    const struct sb_runs *runs = &all->runs;
    for (int i = 0; i < runs->count; i++)
        if (runs->pair[i].verdict == SB_RUN_REFUSED)
            return sb_fail(err, SB_BAD_INPUT,
                           "nothing to compare: %d rows of other conditions, the first, "
                           "%s: %s; --force compares them all the same",
                           runs->of[SB_RUN_REFUSED], runs->pair[i].a->variant,
                           runs->pair[i].differs);
    return sb_fail(err, SB_BAD_INPUT,
                   "nothing to compare: %s and %s have no row in common",
                   all->a.compared.path, all->b.compared.path);
}

// --- text -----------------------------------------------------------------------------------

static const char *const code_words[] = {[SB_RUN_CODE_UNKNOWN] = "",
                                         [SB_RUN_CODE_SAME] = "same",
                                         [SB_RUN_CODE_CHANGED] = "changed"};

static const char *change_word(enum sb_run_change change)
{
    return change == SB_RUN_BETTER ? "better" : change == SB_RUN_WORSE ? "worse" : "";
}

static void print_head(const struct comparison *all)
{
    const struct run *const runs[] = {&all->a, &all->b};
    for (int i = 0; i < 2; i++) {
        const struct sb_row *row = runs[i]->compared.rows.row;
        int64_t most = 0;
        for (int k = 0; k < runs[i]->compared.rows.count; k++)
            most = row[k].processes > most ? row[k].processes : most;
        printf("%c: %s, %d rows, processes: %" PRId64 "; %s, %s, timer %s%s\n", "AB"[i],
               runs[i] -> compared.path, runs[i]->compared.rows.count, most,
               row->renderer ? row->renderer : "?", row->version ? row->version : "?",
               row->timer_source ? row->timer_source : "?",
               runs[i]->fact_count ? "" : "; no run.json: its machine is not known");
    }
    printf(
        "B/A: frame time of B over that of A, with its 95 %% interval; unchanged: within "
        "%g %%\n",
        100 * all->tolerance);
    if (all->runs.within)
        printf(
            "One process a side: the intervals cover the levels of these two processes, "
            "and not what\nothers would have had. Levels differ between processes by "
            "more than that (docs/method.md), so\nthis is no gate: that is `shadebench "
            "gate`, or here --processes 3 in both runs.\n");
    if (all->runs.between)
        printf("Several processes: Student's t over their medians. What differed between "
               "the "
               "processes of a run is\nin the interval; what the machine did between the "
               "two "
               "runs is not (docs/method.md).\n");
}

// What the table has columns for.
struct columns {
    bool ids; // the runs have axes of their own: only ids tell their rows apart
    bool source, binary, errors, changes, status;
    struct sb_keys keys;
    struct sb_row *row; // of each pair: A's, or where there is none B's
};

static bool same_axes(const struct sb_axes *a, const struct sb_axes *b)
{
    bool same = a->count == b->count;
    for (int i = 0; same && i < a->count; i++)
        same = strcmp(a->row[i].name, b->row[i].name) == 0 &&
               a->row[i].value_count == b->row[i].value_count;
    return same;
}

static void make_columns(const struct comparison *all, struct columns *columns)
{
    const struct sb_runs *runs = &all->runs;
    *columns =
        (struct columns){.ids = !same_axes(all->a.compared.axes, all->b.compared.axes)};
    columns->row = sb_alloc(((size_t)runs->count + 1) * sizeof *columns->row);
    for (int i = 0; i < runs->count; i++) {
        const struct sb_run_pair *pair = &runs->pair[i];
        const struct sb_row *const rows[] = {pair->a, pair->b};
        columns->row[i] = pair->a ? *pair->a : *pair->b;
        columns->source |= pair->source != SB_RUN_CODE_UNKNOWN;
        columns->binary |= pair->binary != SB_RUN_CODE_UNKNOWN;
        columns->changes |= pair->error != SB_RUN_SAME;
        for (int k = 0; k < 2; k++)
            if (rows[k]) {
                columns->errors |= !isnan(rows[k]->max_err);
                columns->status |= strcmp(rows[k]->status, "ok") != 0;
            }
    }
    if (!columns->ids)
        sb_keys_make(&columns->keys, all->a.compared.axes, columns->row, runs->count);
}

static void add_titles(const struct columns *columns, struct sb_table *table)
{
    static const char *const times[] = {"A ms", "B ms", "B/A", "95 %"},
                             *const errors[] = {"max err A", "max err B"};
    if (columns->ids) {
        sb_table_column(table, "scene", false);
        sb_table_column(table, "variant", false);
    } else {
        sb_keys_columns(&columns->keys, table);
    }
    for (int i = 0; i < 4; i++)
        sb_table_column(table, times[i], true);
    sb_table_column(table, "verdict", false);
    if (columns->source)
        sb_table_column(table, "source", false);
    if (columns->binary)
        sb_table_column(table, "binary", false);
    for (int i = 0; columns->errors && i < 2; i++)
        sb_table_column(table, errors[i], true);
    if (columns->changes)
        sb_table_column(table, "error", false);
    if (columns->status)
        sb_table_column(table, "status", false);
}

static void add_status(const struct sb_run_pair *pair, struct sb_table *table)
{
    const char *a = pair->a ? pair->a->status : "none",
               *b = pair->b ? pair->b->status : "none";
    if (strcmp(a, b) == 0)
        sb_table_cell(table, a);
    else
        sb_table_cellf(table, "%s > %s", a, b);
}

static void add_pair(const struct columns *columns, const struct sb_run_pair *pair,
                     const struct sb_row *row, struct sb_table *table)
{
    if (columns->ids) {
        sb_table_cell(table, row->scene);
        sb_table_cell(table, row->variant);
    } else {
        sb_keys_cells(&columns->keys, table, row);
    }
    sb_table_real(table, "%.3f", pair->a ? pair->a->median_ms : NAN);
    sb_table_real(table, "%.3f", pair->b ? pair->b->median_ms : NAN);
    sb_table_real(table, "%.3f", pair->ratio.point);
    if (isnan(pair->ratio.lo))
        sb_table_cell(table, "");
    else
        sb_table_cellf(table, "%.3f … %.3f", pair->ratio.lo, pair->ratio.hi);
    sb_table_cellf(table, "%s%s", sb_run_verdict_rows[pair->verdict].word,
                   pair->unlike && pair->verdict != SB_RUN_REFUSED ? " (forced)" : "");
    if (columns->source)
        sb_table_cell(table, code_words[pair->source]);
    if (columns->binary)
        sb_table_cell(table, code_words[pair->binary]);
    if (columns->errors) {
        sb_table_real(table, "%.3g", pair->a ? pair->a->max_err : NAN);
        sb_table_real(table, "%.3g", pair->b ? pair->b->max_err : NAN);
    }
    if (columns->changes)
        sb_table_cell(table, change_word(pair->error));
    if (columns->status)
        add_status(pair, table);
}

// The same words about many rows are said once.
static void print_differences(const struct sb_runs *runs)
{
    for (int i = 0; i < runs->count; i++) {
        const char *differs = runs->pair[i].differs;
        int others = 0;
        bool said = !*differs;
        for (int j = 0; j < runs->count && !said; j++)
            if (j != i && strcmp(runs->pair[j].differs, differs) == 0) {
                said = j < i;
                others++;
            }
        if (said)
            continue;
        printf("%s", runs->pair[i].a->variant);
        if (others)
            printf(" and %d more", others);
        printf(": %s\n", differs);
    }
}

static void print_counts(const struct sb_runs *runs)
{
    printf("\n");
    for (int i = 0; i < SB_RUN_VERDICT_COUNT; i++)
        printf("%s%d %s", i ? ", " : "", runs->of[i], sb_run_verdict_rows[i].word);
    printf("\n");
    if (runs->moved)
        printf("%d of those helped or hurt have the same GLSL in both runs: what moved "
               "there "
               "is the processes'\nlevels, or the program around the shaders\n",
               runs->moved);
}

static void print_text(const struct comparison *all)
{
    const struct sb_runs *runs = &all->runs;
    struct sb_table *table = sb_table_new();
    struct columns columns;
    print_head(all);
    printf("\n");
    make_columns(all, &columns);
    add_titles(&columns, table);
    for (int i = 0; i < runs->count; i++)
        add_pair(&columns, &runs->pair[i], &columns.row[i], table);
    sb_table_print(table);
    print_differences(runs);
    print_counts(runs);
    free(columns.row);
    sb_table_free(&table);
}

// --- JSON -----------------------------------------------------------------------------------

static json_t *text_json(const char *text)
{
    return text && *text ? json_string(text) : json_null();
}

static json_t *row_json(const struct sb_row *row)
{
    static const char *const shown[] = {
        "variant", "median_ms", "ci_lo_ms",  "ci_hi_ms",    "processes",
        "status",  "max_err",   "nonfinite", "source_hash", "binary_hash"};
    json_t *object = row ? json_object() : json_null();
    for (int c = 0; row && c < sb_summary_column_count; c++)
        for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
            const struct sb_column *column = &sb_summary_columns[c];
            if (column->name && strcmp(column->name, shown[i]) == 0)
                json_object_set_new(object, shown[i], sb_report_cell_json(row, column));
        }
    return object;
}

static json_t *pair_json(const struct sb_run_pair *pair)
{
    const struct sb_row *row = pair->a ? pair->a : pair->b;
    json_t *object =
        json_pack("{sssososs}", "scene", row->scene, "a", row_json(pair->a), "b",
                  row_json(pair->b), "verdict", sb_run_verdict_rows[pair->verdict].word);
    json_object_set_new(object, "ratio", sb_compare_number(pair->ratio.point));
    json_object_set_new(object, "ratio_lo", sb_compare_number(pair->ratio.lo));
    json_object_set_new(object, "ratio_hi", sb_compare_number(pair->ratio.hi));
    json_object_set_new(object, "ci_kind",
                        isnan(pair->ratio.lo) ? json_null()
                        : pair->between       ? json_string("ci95_between_processes")
                                              : json_string("ci95_within_run"));
    json_object_set_new(object, "source", text_json(code_words[pair->source]));
    json_object_set_new(object, "binary", text_json(code_words[pair->binary]));
    json_object_set_new(object, "error", text_json(change_word(pair->error)));
    json_object_set_new(object, "status", text_json(change_word(pair->status)));
    json_object_set_new(object, "differs", text_json(pair->differs));
    json_object_set_new(object, "forced",
                        json_boolean(pair->unlike && pair->verdict != SB_RUN_REFUSED));
    return object;
}

static json_t *comparison_json(const struct comparison *all)
{
    json_t *counts = json_object(), *list = json_array();
    for (int i = 0; i < SB_RUN_VERDICT_COUNT; i++)
        json_object_set_new(counts, sb_run_verdict_rows[i].word,
                            json_integer(all->runs.of[i]));
    for (int i = 0; i < all->runs.count; i++)
        json_array_append_new(list, pair_json(&all->runs.pair[i]));
    return json_pack("{sssssfsosisiso}", "a", all->a.compared.path, "b",
                     all->b.compared.path, "tolerance", all->tolerance, "counts", counts,
                     "worse", all->runs.worse, "moved", all->runs.moved, "rows", list);
}

static int report(const struct comparison *all)
{
    if (all->options->json)
        sb_cli_print_json(comparison_json(all));
    else
        print_text(all);
    return all->options->check && all->runs.worse ? 1 : 0;
}

int sb_compare_runs(const struct sb_options *options)
{
    struct sb_error err = {0};
    struct comparison all = {.options = options};
    bool good = load(&all, &err);
    if (good) {
        sb_runs_compare(
            &(struct sb_runs_params){
                .a = side_of(&all.a),
                .b = side_of(&all.b),
                .tolerance = all.tolerance,
                .force = options->force,
            },
            &all.runs);
        good = all.runs.comparable > 0 || fail_nothing(&all, &err);
    }
    const int code = good ? report(&all) : sb_cli_fail(&err);
    sb_runs_free(&all.runs);
    sb_results_free(&all.a.compared);
    sb_results_free(&all.b.compared);
    sb_arena_free(&all.arena);
    return code;
}
