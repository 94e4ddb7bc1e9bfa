// What a gate prints: regressions and wrong pictures first, what passed last.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "cli/gate.h"
#include "cli/keys.h"
#include "cli/report.h"
#include "cli/table.h"
#include "stats/counts.h"

// What a reader must see first.
static int rank(const struct sb_gate_row *row)
{
    static const enum sb_gate_verdict order[] = {
        SB_GATE_REGRESSION,    SB_GATE_INVALID,  SB_GATE_INCONCLUSIVE,
        SB_GATE_NOT_CONFIRMED, SB_GATE_IMPROVED, SB_GATE_PASS};
    if (!row->verdict)
        return 0; // of a self-test
    const enum sb_gate_verdict verdict = sb_gate_verdict_find(row->verdict);
    for (int i = 0; i < (int)(sizeof order / sizeof *order); i++)
        if (order[i] == verdict)
            return i;
    return SB_GATE_VERDICT_COUNT; // skipped: counted, not shown
}

// Instructions: what they are of, and what they say nothing of.
static void print_counting(const struct sb_gate_result *result)
{
    const struct sb_gate_counting *counting = &result->counting;
    printf("rule: tolerance %.3g %% over %d variants; %d counts of one frame a side, "
           "more where these do not agree, "
           "candidates counted again in a fresh process\n",
           100 * result->rule.tolerance, result->rule.variants, SB_COUNTS_REPEATS);
    if (counting->other_code[0])
        printf("%s\n", counting->other_code);
    printf("\n");
}

static bool any_timed(const struct sb_gate_result *result)
{
    for (int i = 0; i < result->row_count; i++)
        if (result->row[i].pairs != SB_NO_COUNT)
            return true;
    return false;
}

static void print_head(const struct sb_gate_shown *shown)
{
    const struct sb_gate_result *result = shown->result;
    const struct sb_gate_rule *rule = &result->rule;
    const struct sb_caps *base = &result->caps[SB_BASE], *head = &result->caps[SB_HEAD];
    const bool apart = strcmp(base->renderer, head->renderer) != 0 ||
                       strcmp(base->version, head->version) != 0;
    printf("gate %s: base %s, head %s\n", shown->suite->name, shown->base, shown->head);
    for (int side = 0; side < (apart ? SB_SIDES : 1); side++)
        printf("driver%s%s: %s, %s%s\n", apart ? " of " : "",
               apart ? sb_side_names[side] : "", result->caps[side].renderer,
               result->caps[side].version,
               shown->pinned && result->caps[side].software
                   ? ", LP_NUM_THREADS=1 (pinned; set it to keep yours)"
                   : "");
    printf("metric: %s (%s)%s\n", sb_metric_rows[result->metric].name, result->timer,
           result->caps[SB_BASE].software
               ? "; ratios are those of a CPU driver, not of a GPU"
               : "");
    if (result->metric == SB_METRIC_INSTRUCTIONS) {
        print_counting(result);
        return;
    }
    if (!any_timed(result)) {
        printf("rule: no variant was timed\n\n");
        return;
    }
    printf("rule: tolerance %.3g %%, alpha %.3g %% over %d timed variants, looks at %d "
           "to %d "
           "pairs, candidates confirmed by %d pairs in a fresh %s\n\n",
           100 * rule->tolerance, 100 * rule->alpha, rule->variants, rule->looks.first,
           rule->looks.rounds, rule->confirm_pairs,
           shown->options->in_process ? "context of this process" : "process");
}

// What tells the variants apart, as tables of runs have it.
struct names {
    struct sb_row *row;
    struct sb_keys keys;
};

static void names_make(struct names *names, const struct sb_suite *suite)
{
    names->row = sb_alloc(((size_t)suite->entry_count + 1) * sizeof *names->row);
    for (int i = 0; i < suite->entry_count; i++) {
        sb_row_init(&names->row[i]);
        names->row[i].axes = &suite->entry[i].variant;
        names->row[i].scene = suite->entry[i].scene;
        names->row[i].variant = suite->entry[i].id;
    }
    sb_keys_make(&names->keys, &suite->axes, names->row, suite->entry_count);
    names->keys.scene = names->keys.id = true;
}

static void print_row(struct sb_table *table, const struct names *names, int i,
                      const struct sb_gate_row *row)
{
    const bool counts = isfinite(row->base_instructions);
    sb_keys_cells(&names->keys, table, &names->row[i]);
    sb_table_real(table, counts ? "%.0f" : "%.4g",
                  counts ? row->base_instructions : row->base_ms);
    sb_table_real(table, counts ? "%.0f" : "%.4g",
                  counts ? row->head_instructions : row->head_ms);
    sb_table_real(table, counts ? "%.5f" : "%.4f", row->ratio);
    if (isfinite(row->ratio_lo) && isfinite(row->ratio_hi))
        sb_table_cellf(table, counts ? "%.5f … %.5f" : "%.4f … %.4f", row->ratio_lo,
                       row->ratio_hi);
    else
        sb_table_cell(table, NULL);
    if (row->pairs != SB_NO_COUNT)
        sb_table_cellf(table, "%lld", (long long)row->pairs);
    else
        sb_table_cell(table, NULL);
    sb_table_cell(table, row->picture);
    sb_table_cell(table, row->verdict);
    if (row->status_of)
        sb_table_cellf(table, "%s: %s", row->status_of, row->status);
    else
        sb_table_cell(table, NULL);
}

static void print_table(const struct sb_gate_result *result, const struct sb_suite *suite)
{
    struct sb_table *table = sb_table_new();
    struct names names;
    int shown = 0;
    const bool counts = result->metric == SB_METRIC_INSTRUCTIONS;
    const char *const right[] = {counts ? "base instr." : "base ms",
                                 counts ? "head instr." : "head ms", "ratio",
                                 counts ? "range" : "95 %", counts ? "counts" : "pairs"};
    names_make(&names, suite);
    sb_keys_columns(&names.keys, table);
    for (int i = 0; i < 5; i++)
        sb_table_column(table, right[i], true);
    sb_table_column(table, "picture", false);
    sb_table_column(table, "verdict", false);
    sb_table_column(table, "status", false);
    for (int r = 0; r < SB_GATE_VERDICT_COUNT; r++)
        for (int i = 0; i < result->row_count; i++)
            if (rank(&result->row[i]) == r) {
                print_row(table, &names, i, &result->row[i]);
                shown++;
            }
    if (shown)
        sb_table_print(table);
    sb_table_free(&table);
    free(names.row);
}

static bool same_note(const struct sb_gate_row *a, const struct sb_gate_row *b)
{
    return b->note && strcmp(a->note, b->note) == 0 && strcmp(a->status, b->status) == 0;
}

// What befell several rows alike is told once.
static void print_note(const struct sb_gate_result *result, int place,
                       const char *verdict)
{
    const struct sb_gate_row *row = &result->row[place];
    int more = 0;
    for (int i = 0; i < result->row_count; i++) {
        if (i < place && same_note(row, &result->row[i]))
            return;
        more += i > place && same_note(row, &result->row[i]);
    }
    printf("%s: %s %s", strcmp(row->status, "ok") == 0 ? verdict : row->status,
           row->scene, row->variant);
    if (more > 0)
        printf(" and %d more", more);
    printf(": %s\n", row->note);
}

// One line for each row that needs words.
static void print_notes(const struct sb_gate_result *result)
{
    for (int i = 0; i < result->row_count; i++) {
        const struct sb_gate_row *row = &result->row[i];
        const char *verdict = row->verdict ? row->verdict : "self-test";
        if (isfinite(row->confirm_ratio))
            printf("%s: %s %s: ratio %.4f here, %.4f in a fresh process", verdict,
                   row->scene, row->variant, row->ratio, row->confirm_ratio);
        if (isfinite(row->confirm_p))
            printf(" (p %.2g)", row->confirm_p);
        if (isfinite(row->confirm_ratio))
            printf("\n");
        if (row->note && sb_gate_verdict_find(verdict) != SB_GATE_SKIPPED)
            print_note(result, i, verdict);
    }
}

static void print_bias(const struct sb_gate_shown *shown)
{
    const struct sb_gate_bias *bias = &shown->result->bias;
    const double tolerance = shown->result->rule.tolerance;
    if (bias->variant < 0) {
        printf("bias: no variant was timed\n");
        return;
    }
    if (shown->result->bias_incomplete) {
        printf("bias: not known: a variant has fewer than %d pairs%s\n",
               shown->result->rule.confirm_pairs,
               shown->result->interrupted
                   ? ""
                   : "; give it more time (--budget SECONDS), or a quieter machine");
        return;
    }
    printf("bias: of two equal programs the one read up to %.2f %% more or less than the "
           "other "
           "(%s; %.4f … %.4f)\n",
           100 * bias->bias, shown->result->row[bias->variant].variant, bias->ratio.lo,
           bias->ratio.hi);
    if (bias->tolerable)
        printf("a tolerance of %.3g %% is at least twice that: it can be used here\n",
               100 * tolerance);
    else
        printf("a tolerance of %.3g %% is under twice that: refused; --tolerance %.1f%% "
               "or more, "
               "or a quieter machine\n",
               100 * tolerance, ceil(20 * 100 * bias->bias) / 10);
}

static void print_repeatability(const struct sb_gate_counting *counting)
{
    printf("repeatability: counts of one frame differed by at most %.2g %%",
           100 * counting->repeatability);
    if (counting->apart > 0)
        printf(", but for %d of %d that stood apart, by up to %+.2g %%: what the driver "
               "does once in many frames is no part of one",
               counting->apart, counting->counts, 100 * counting->farthest);
    printf("\n");
}

static void print_foot(const struct sb_gate_shown *shown)
{
    const struct sb_gate_result *result = shown->result;
    const char *comma = "";
    printf("\n");
    for (int v = 0; v < SB_GATE_VERDICT_COUNT; v++)
        if (result->count[v] > 0 && !(shown->options->selftest && v != SB_GATE_INVALID)) {
            printf("%s%d %s", comma, result->count[v], sb_gate_verdict_rows[v].word);
            comma = ", ";
        }
    if (*comma)
        printf("\n");
    if (result->count[SB_GATE_SKIPPED] > 0)
        printf(
            "skipped: the final sources of both sides are equal, so there is nothing to "
            "time\n");
    if (shown->lost && shown->lost->unknown)
        printf("hard cases: not known, since base's cannot be verified\n");
    else if (shown->lost)
        printf("hard cases: %d that base passes and head does not\n", shown->lost->count);
    if (isfinite(result->counting.repeatability) &&
        result->metric == SB_METRIC_INSTRUCTIONS)
        print_repeatability(&result->counting);
    if (isfinite(result->median_mde))
        printf("least slowdown that so many pairs find in nine of ten gates: %.2g %% "
               "(median "
               "over the variants)\n",
               100 * result->median_mde);
    printf("%.1f s; results: %s/gate.csv\n", result->seconds, shown->dir);
    if (result->interrupted)
        printf("interrupted: what is not judged is inconclusive\n");
}

void sb_gate_print(const struct sb_gate_shown *shown)
{
    print_head(shown);
    print_table(shown->result, shown->suite);
    print_notes(shown->result);
    if (shown->options->selftest)
        print_bias(shown);
    print_foot(shown);
}

json_t *sb_gate_json(const struct sb_gate_shown *shown)
{
    const struct sb_gate_result *result = shown->result;
    json_t *object = json_object(), *rows = json_array(), *counts = json_object();
    for (int i = 0; i < result->row_count; i++) {
        json_t *row = json_object();
        for (int c = 0; c < sb_gate_column_count; c++)
            json_object_set_new(
                row, sb_gate_columns[c].name,
                sb_report_cell_json(&result->row[i], &sb_gate_columns[c]));
        json_array_append_new(rows, row);
    }
    for (int v = 0; v < SB_GATE_VERDICT_COUNT; v++)
        json_object_set_new(counts, sb_gate_verdict_rows[v].word,
                            json_integer(result->count[v]));
    json_object_set_new(object, "dir", json_string(shown->dir));
    json_object_set_new(object, "metric",
                        json_string(sb_metric_rows[result->metric].name));
    json_object_set_new(object, "tolerance", json_real(result->rule.tolerance));
    json_object_set_new(object, "seconds", json_real(result->seconds));
    json_object_set_new(object, "interrupted", json_boolean(result->interrupted));
    if (isfinite(result->median_mde))
        json_object_set_new(object, "mde", json_real(result->median_mde));
    if (shown->options->selftest && isfinite(result->bias.bias))
        json_object_set_new(object, "bias", json_real(result->bias.bias));
    if (shown->lost && !shown->lost->unknown)
        json_object_set_new(object, "cases_lost", json_integer(shown->lost->count));
    json_object_set_new(object, "verdicts", counts);
    json_object_set_new(object, "rows", rows);
    return object;
}
