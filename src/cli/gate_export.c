// A gate for other programs: each variant is a pair of rows, base and head.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/gate.h"

bool sb_gate_base_failed(const struct sb_gate_row *row)
{
    return row->verdict && row->status_of &&
           sb_gate_verdict_find(row->verdict) == SB_GATE_INVALID &&
           strcmp(row->status_of, sb_side_names[SB_BASE]) == 0;
}

// Of a self-test: did equal programs read as more apart than the tolerance allows (stats/gate.h)?
static bool is_biased(const struct sb_gate_row *row)
{
    return !row->verdict && isfinite(row->ratio) &&
           2 * fabs(row->ratio - 1) > row->tolerance;
}

static enum sb_export_outcome outcome_of(const struct sb_gate_row *row)
{
    const enum sb_status status = sb_status_find(row->status);
    if (status == SB_WORSE_PICTURE)
        return SB_EXPORT_FAILED;
    if (!row->verdict) // of a self-test
        return is_biased(row) ? SB_EXPORT_ERROR : SB_EXPORT_PASSED;
    if (sb_gate_base_failed(row))
        return SB_EXPORT_SKIPPED; // nothing to hold head against, which is no fault of its
    switch (sb_gate_verdict_find(row->verdict)) {
    case SB_GATE_REGRESSION:
        return SB_EXPORT_FAILED;
    case SB_GATE_INVALID:
        return SB_EXPORT_ERROR;
    case SB_GATE_PASS:
    case SB_GATE_IMPROVED:
    case SB_GATE_NOT_CONFIRMED:
        return SB_EXPORT_PASSED;
    default:
        return SB_EXPORT_SKIPPED;
    }
}

static const char *details_of(const struct sb_gate_row *row, struct sb_arena *arena)
{
    struct sb_text text = {0};
    if (isfinite(row->ratio))
        sb_text_printf(
            &text,
            "head / base %.4f [%.4f, %.4f] over %lld pairs of %s, tolerance %.3g %%\n",
            row->ratio, row->ratio_lo, row->ratio_hi, (long long)row->pairs, row->metric,
            100 * row->tolerance);
    if (isfinite(row->confirm_ratio))
        sb_text_printf(&text, "in a fresh process %.4f (p %.2g)\n", row->confirm_ratio,
                       row->confirm_p);
    if (row->note)
        sb_text_printf(&text, "%s\n", row->note);
    const char *details = text.length ? sb_arena_strdup(arena, text.data) : NULL;
    sb_text_free(&text);
    return details;
}

// Values of batches as those of frames.
static const double *per_frame(const double *value, int count, int batch,
                               struct sb_arena *arena)
{
    double *frame = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *frame);
    for (int i = 0; i < count; i++)
        frame[i] = value[i] / batch;
    return frame;
}

static struct sb_interval interval_of(const double *value, int count,
                                      struct sb_arena *arena)
{
    double *sorted = sb_arena_alloc(arena, ((size_t)count + 1) * sizeof *sorted);
    memcpy(sorted, value, (size_t)count * sizeof *sorted);
    sb_sort_doubles(sorted, count);
    return sb_median_interval(sorted, count, 0.95);
}

// Not measured because there is nothing to measure: what is for accuracy only is skipped, too.
static bool is_equal(const struct sb_gate_row *row)
{
    return row->verdict && sb_gate_verdict_find(row->verdict) == SB_GATE_SKIPPED &&
           row->base_source && row->head_source &&
           strcmp(row->base_source, row->head_source) == 0;
}

static void fill_samples(const struct sb_gate_shown *shown, int i, enum sb_side side,
                         struct sb_arena *arena, struct sb_export_row *to)
{
    const struct sb_gate_row *row = &shown->result->row[i];
    const enum sb_metric metric = shown->result->metric;
    const int count = row->pairs == SB_NO_COUNT ? 0 : (int)row->pairs;
    if (count == 0)
        return;
    const double *sample =
        per_frame(sb_gate_values(shown->result, i, side), count, (int)row->batch, arena);
    to->batch = (int)row->batch;
    to->sample_count = count;
    if (metric == SB_METRIC_INSTRUCTIONS) {
        struct sb_export_counter *counter = sb_arena_alloc(arena, sizeof *counter);
        *counter = (struct sb_export_counter){"instructions",
                                              side == SB_BASE ? row->base_instructions
                                                              : row->head_instructions};
        to->counter = counter;
        to->counter_count = 1;
        to->sample_instructions = sample;
        return;
    }
    to->sample_ns = sample;
    to->frame_ns = interval_of(sample, count, arena);
    if (metric == SB_METRIC_CPU) {
        to->cpu_ns = to->frame_ns.point;
        to->sample_cpu_ns = sample;
    }
}

static void fill_side(const struct sb_gate_shown *shown, int i, enum sb_side side,
                      struct sb_arena *arena, struct sb_export_row *to)
{
    const struct sb_gate_row *row = &shown->result->row[i];
    *to = sb_export_row_unknown;
    to->scene = row->scene;
    to->variant = row->variant;
    to->side = sb_side_names[side];
    to->status = row->verdict ? row->verdict : row->status;
    to->outcome = outcome_of(row);
    if (strcmp(row->status, "ok") != 0)
        to->status = row->status;
    else if (is_biased(row))
        to->status = sb_status_rows[SB_SAMPLES_INVALID].word;
    fill_samples(shown, i, side, arena, to);
    if (side == SB_BASE)
        return;
    to->equal = is_equal(row);
    to->ratio = (struct sb_interval){.point = row->ratio,
                                     .lo = row->ratio_lo,
                                     .hi = row->ratio_hi,
                                     .n = to->sample_count};
    to->message = row->note || !is_biased(row)
                      ? row->note
                      : "two equal programs read as different by more than half the "
                        "tolerance: refused";
    to->details = details_of(row, arena);
}

// A hard case that head does not hold has a result of its own, without a time. Those that it
// holds are in cases.csv.
static void fill_lost(const struct sb_gate_lost_case *lost, struct sb_export_row *to)
{
    *to = sb_export_row_unknown;
    to->scene = "hard cases";
    to->variant = lost->cell;
    to->side = sb_side_names[SB_HEAD];
    to->outcome = SB_EXPORT_FAILED;
    to->status = "fail";
    to->message = lost->says;
}

static const char *number(struct sb_arena *arena, double value)
{
    char text[32];
    return sb_arena_strdup(arena, sb_number_text(value, text));
}

void sb_gate_export(const struct sb_gate_shown *shown, struct sb_arena *arena,
                    struct sb_export *export)
{
    const struct sb_gate_result *result = shown->result;
    enum { PROPERTIES = 8 };
    const int lost = shown->lost ? shown->lost->count : 0;
    const int rows = SB_SIDES * result->row_count;
    struct sb_export_row *row =
        sb_arena_alloc(arena, (size_t)(rows + lost + 1) * sizeof *row);
    struct sb_export_property *property =
        sb_arena_alloc(arena, PROPERTIES * sizeof *property);
    const struct sb_export_property found[PROPERTIES] = {
        {"renderer", result->caps[SB_HEAD].renderer, SB_EXPORT_TEXT, SB_EXPORT_HEAD},
        {"gl_version", result->caps[SB_HEAD].version, SB_EXPORT_TEXT, 0},
        {"timer", result->timer, SB_EXPORT_TEXT, SB_EXPORT_HEAD},
        {"tolerance", number(arena, result->rule.tolerance), SB_EXPORT_NUMBER,
         SB_EXPORT_HEAD},
        {"base", shown->base, SB_EXPORT_TEXT, SB_EXPORT_HEAD | SB_EXPORT_ONCE},
        {"head", shown->head, SB_EXPORT_TEXT, SB_EXPORT_HEAD | SB_EXPORT_ONCE},
        {"mde", isfinite(result->median_mde) ? number(arena, result->median_mde) : NULL,
         SB_EXPORT_NUMBER, SB_EXPORT_ONCE},
        {"shadebench", SB_VERSION, SB_EXPORT_TEXT, SB_EXPORT_ONCE},
    };
    memcpy(property, found, sizeof found);
    for (int i = 0; i < result->row_count; i++)
        for (int side = 0; side < SB_SIDES; side++)
            fill_side(shown, i, (enum sb_side)side, arena, &row[SB_SIDES * i + side]);
    for (int i = 0; i < lost; i++)
        fill_lost(&shown->lost->it[i], &row[rows + i]);
    *export = (struct sb_export){
        .name = sb_arena_printf(arena, "shadebench gate %s", shown->suite->name),
        .property = property,
        .property_count = PROPERTIES,
        .row = row,
        .row_count = rows + lost,
    };
}
