#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analyse/pareto.h"
#include "base/mem.h"

bool sb_pareto_keeps_apart(const struct sb_axis *axis)
{
    if (axis->kind == SB_PLATFORM || axis->kind == SB_SCENE || axis->flags & SB_APART)
        return true;
    for (int v = 0; v < axis->value_count; v++)
        if (axis->values[v].flags & SB_APART)
            return true;
    return false;
}

static bool same_axes(const struct sb_axes *axes, const struct sb_row *a,
                      const struct sb_row *b, bool analytic)
{
    for (int i = 0; i < axes->count; i++)
        if (a->axes->value[i] != b->axes->value[i] &&
            sb_pareto_keeps_apart(&axes->row[i]) &&
            !(analytic && axes->row[i].flags & SB_TRUTH))
            return false;
    return true;
}

bool sb_pareto_comparable(const struct sb_pareto_params *params, const struct sb_row *a,
                          const struct sb_row *b)
{
    if (!sb_text_same(a->scene, b->scene) || !sb_text_same(a->renderer, b->renderer) ||
        !sb_text_same(a->version, b->version) ||
        !sb_text_same(a->timer_source, b->timer_source) ||
        !sb_text_same(a->ci_kind, b->ci_kind))
        return false;
    const bool analytic = params->analytic && a->scene && params->analytic(a->scene);
    // Other triangles of an analytic scene are other input for the same question.
    return (analytic || sb_text_same(a->input_hash, b->input_hash)) &&
           same_axes(params->axes, a, b, analytic);
}

// Both a time and an error, and neither in doubt.
static bool is_ranked(const struct sb_axes *axes, const struct sb_row *row)
{
    const enum sb_status status = row->status ? sb_status_find(row->status) : SB_INTERNAL;
    const double real[] = {row->median_ms, row->ci_lo_ms, row->ci_hi_ms,
                           row->max_err,   row->p999_err, row->flip_mean};
    for (size_t i = 0; i < sizeof real / sizeof *real; i++)
        if (isnan(real[i]))
            return false;
    return row->ci_lo_ms <= row->ci_hi_ms && row->median_ms > 0 &&
           row->nonfinite != SB_NO_COUNT && status != SB_STATUS_COUNT &&
           sb_status_rows[status].exit_code == 0 && !sb_variant_untimed(axes, row->axes);
}

static bool dominates(const struct sb_pareto_params *params, const struct sb_row *a,
                      const struct sb_row *b)
{
    // The axes last: they take longest.
    return a->ci_hi_ms < b->ci_lo_ms && a->max_err <= b->max_err &&
           a->p999_err <= b->p999_err && a->flip_mean <= b->flip_mean &&
           a->nonfinite <= b->nonfinite && sb_pareto_comparable(params, a, b);
}

static bool is_better(const struct sb_row *a, const struct sb_row *b)
{
    if (a->max_err != b->max_err)
        return a->max_err < b->max_err;
    return a->median_ms < b->median_ms;
}

// Dominance is transitive, so whatever is dominated is so by a row on the front.
static void name_dominator(const struct sb_pareto_params *params, struct sb_row *row)
{
    const struct sb_row *best = NULL;
    for (int i = 0; i < params->count; i++) {
        const struct sb_row *other = &params->row[i];
        if (other->front && strcmp(other->front, "front") == 0 &&
            dominates(params, other, row) && (!best || is_better(other, best)))
            best = other;
    }
    if (!best)
        return;
    row->dominated_by = best->variant;
    row->dominated_time = row->median_ms / best->median_ms;
    row->dominated_err = row->max_err == best->max_err ? 1 : row->max_err / best->max_err;
}

void sb_pareto_mark(const struct sb_pareto_params *params)
{
    struct sb_row *const rows = params->row;
    bool *ranked = sb_alloc((size_t)params->count + 1);
    for (int i = 0; i < params->count; i++) {
        ranked[i] = is_ranked(params->axes, &rows[i]);
        rows[i].front = ranked[i] ? "front" : NULL;
        rows[i].dominated_by = NULL;
        rows[i].dominated_time = rows[i].dominated_err = NAN;
    }
    for (int i = 0; i < params->count; i++)
        for (int j = 0; ranked[i] && j < params->count; j++)
            if (ranked[j] && dominates(params, &rows[j], &rows[i])) {
                rows[i].front = "dominated";
                break;
            }
    for (int i = 0; i < params->count; i++)
        if (rows[i].front && strcmp(rows[i].front, "dominated") == 0)
            name_dominator(params, &rows[i]);
    free(ranked);
}

// Three digits, so that 1.04 times is not 1.0 times.
static void add_times(struct sb_text *text, double times)
{
    const int decimals = times < 10 ? 2 : times < 100 ? 1 : 0;
    sb_text_printf(text, times < 1e6 ? "%.*f times" : "%.*e times", decimals, times);
}

void sb_pareto_text(const struct sb_row *row, const char *id, struct sb_text *text)
{
    if (!row->front)
        return;
    if (!row->dominated_by) {
        sb_text_add(text, row->front);
        return;
    }
    sb_text_printf(text, "dominated by %s (", id);
    add_times(text, row->dominated_time);
    sb_text_add(text, " slower, ");
    if (row->dominated_err == 1) {
        sb_text_add(text, "the same error)");
    } else if (isinf(row->dominated_err)) {
        sb_text_add(text, "an error where that has none)");
    } else {
        add_times(text, row->dominated_err);
        sb_text_add(text, " the error)");
    }
}
