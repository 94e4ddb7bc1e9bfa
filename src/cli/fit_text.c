// What `fit` prints.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/fit.h"
#include "cli/table.h"

static const char about[] = "ms = lit + the sum over the types of (ms with that type "
                            "alone - lit); lit is paid once, "
                            "however\nmany types there are. Nothing is said outside the "
                            "counts and densities that were "
                            "measured.\n";

static void add_interval(struct sb_table *table, double lo, double hi)
{
    if (isnan(lo) || isnan(hi))
        sb_table_cell(table, "");
    else
        sb_table_cellf(table, "[%.3f, %.3f]", lo, hi);
}

// --- prices -------------------------------------------------------------------------------

// What a reader should know of the shape, a line a type.
static void print_shape(const struct sb_fit_report *report,
                        const struct sb_fit_type *type)
{
    const char *name = report->compared->axes->row[type->axis].name;
    if (type->shape == SB_FIT_BEND)
        printf("%s: flat; up to %.1f of them cost no more than the first\n", name,
               type->curve.at);
    else if (type->shape == SB_FIT_UNEVEN)
        printf("%s: no line: %s=%g is %.1f %% %s it; read off between the counts\n", name,
               name, type->off_n, 100 * fabs(type->off),
               type->off < 0 ? "under" : "over");
    if (type->jump_ms > 0)
        printf("%s: between %g and %g the time rises by %.3f ms more than elsewhere; a "
               "driver may compile more lights otherwise\n",
               name, type->jump_from, type->jump_to, type->jump_ms);
}

static void print_prices(const struct sb_fit_report *report,
                         const struct sb_fit_group *group)
{
    struct sb_table *table = sb_table_new();
    struct sb_text text = {0};
    bool few = false;
    sb_table_column(table, "type", false);
    sb_table_column(table, "counts", false);
    sb_table_column(table, "ms a light", true);
    sb_table_column(table, "95 %", false);
    sb_table_column(table, "first, ms more", true);
    sb_table_column(table, "shape", false);
    sb_table_column(table, "farthest off the line", false);
    for (int t = 0; t < group->types; t++) {
        const struct sb_fit_type *type = &group->type[t];
        sb_table_cell(table, report->compared->axes->row[type->axis].name);
        sb_text_clear(&text);
        for (int c = 0; c < type->counts; c++)
            sb_text_printf(&text, "%s%g", c ? " " : "", type->count[c].n);
        sb_table_cell(table, sb_text_get(&text));
        sb_table_real(table, "%.4f", type->price.point);
        if (isnan(type->price.lo))
            sb_table_cell(table, "");
        else
            sb_table_cellf(table, "[%.4f, %.4f]", type->price.lo, type->price.hi);
        few |= isnan(type->price.lo);
        sb_table_real(table, "%.3f", type->first_ms);
        sb_table_cell(table, sb_fit_shape_words[type->shape]);
        sb_table_cellf(table, "%+.1f %% at %g", 100 * type->off, type->off_n);
    }
    sb_table_print(table);
    for (int t = 0; t < group->types; t++)
        print_shape(report, &group->type[t]);
    if (few)
        printf("no interval of a slope: it takes five counts\n");
    sb_table_free(&table);
    sb_text_free(&text);
}

static void print_floor(const struct sb_fit_group *group)
{
    const struct sb_row *base = group->base;
    if (isnan(group->lit_ms))
        printf(
            "the row of the lowest counts is not in the run: mixes are not predicted\n");
    else if (!base)
        printf("the frame without lights is not in the run; the lines begin at %.3f ms\n",
               group->lit_ms);
    else if (group->unlit)
        printf("without lights %.3f ms; lit %.3f ms: the first light of any type brings "
               "%.3f ms more than the next\n",
               base->median_ms, group->lit_ms, group->first_ms);
    else
        printf("with the lights that all rows have %.3f ms\n", base->median_ms);
}

// --- lights that fit ----------------------------------------------------------------------

static void add_lights(const struct sb_fit_lights *lights, struct sb_text *text)
{
    if (lights->floor)
        sb_text_add(text, "floor");
    else if (lights->above)
        sb_text_printf(text, ">%d", lights->n);
    else if (lights->below)
        sb_text_printf(text, "<%d", lights->n);
    else
        sb_text_printf(text, "%d", lights->n);
}

static void print_lights(const struct sb_fit_report *report,
                         const struct sb_fit_group *group)
{
    double ms[SB_BUDGETS_MAX];
    const int count = sb_fit_budgets(report, group, ms);
    struct sb_table *table = sb_table_new();
    struct sb_text text = {0};
    bool floor = false, above = false, below = false;
    sb_table_column(table, "lights that fit in", false);
    for (int b = 0; b < count; b++) {
        sb_text_clear(&text);
        sb_text_printf(&text, "%g ms", ms[b]);
        sb_table_column(table, sb_text_get(&text), false);
    }
    for (int t = 0; t < group->types; t++) {
        sb_table_cell(table, report->compared->axes->row[group->type[t].axis].name);
        for (int b = 0; b < count; b++) {
            struct sb_fit_lights lights[3]; // estimate, fewest, most
            sb_text_clear(&text);
            for (int i = 0; i < 3; i++) {
                const int side = i == 0 ? 0 : i == 1 ? -1 : 1;
                lights[i] = sb_fit_lights_in(group, &group->type[t], ms[b], side);
                sb_text_add(&text, i == 0 ? "" : i == 1 ? " [" : ", ");
                add_lights(&lights[i], &text);
                floor |= lights[i].floor;
                above |= lights[i].above;
                below |= lights[i].below;
            }
            sb_text_add(&text, "]");
            sb_table_cell(table, sb_text_get(&text));
        }
    }
    printf("\n");
    sb_table_print(table);
    if (above)
        printf(">N: more than N, not measured\n");
    if (below)
        printf("<N: fewer than N, not measured\n");
    if (floor)
        printf("floor: the frame without them takes longer\n");
    sb_table_free(&table);
    sb_text_free(&text);
}

// --- mixes --------------------------------------------------------------------------------

static void print_verdict(const struct sb_fit_group *group)
{
    int wrong = 0, outside = 0, in_jump = 0;
    for (int m = 0; m < group->mixes; m++) {
        wrong += fabs(group->mix[m].off) > SB_FIT_WRONG;
        outside += group->mix[m].outside;
        in_jump += group->mix[m].in_jump;
    }
    if (group->predicted < group->mixes)
        printf("%d of %d mixes hold counts that were not measured for one type alone: no "
               "prediction\n",
               group->mixes - group->predicted, group->mixes);
    if (group->predicted == 0)
        return;
    printf("interaction: types together take %+.1f %% against their sum (median of %d "
           "mixes); largest %+.1f %%\n",
           100 * group->interaction, group->predicted, 100 * group->worst);
    if (wrong > 0)
        printf(
            "off by more than %.0f %%: %d of %d mixes; the model is wrong there: types "
            "together cost %s than their sum\n",
            100 * SB_FIT_WRONG, wrong, group->predicted,
            group->worst < 0 ? "less" : "more");
    else
        printf("all of them are within %.0f %%\n", 100 * SB_FIT_WRONG);
    if (in_jump > 0)
        printf("in a jump: %d of %d; a count lies in the gap in which its type jumps, "
               "and where "
               "is not known: measure counts in that gap\n",
               in_jump, group->predicted);
    if (outside > 0)
        printf("outside their interval: %d of %d; it knows the scatter of each type, not "
               "what "
               "types do to each other\n",
               outside, group->predicted);
}

static void print_mixes(const struct sb_fit_report *report,
                        const struct sb_fit_group *group)
{
    struct sb_table *table = sb_table_new();
    struct sb_text text = {0};
    printf("\n");
    if (group->mixes == 0)
        printf("no mixes of types in the run: nothing says whether their costs add up\n");
    sb_table_column(table, "mix, not fitted", false);
    sb_table_column(table, "measured ms", true);
    sb_table_column(table, "predicted", true);
    sb_table_column(table, "interval", false);
    sb_table_column(table, "off", true);
    sb_table_column(table, "", false);
    for (int m = 0; m < group->mixes; m++) {
        const struct sb_fit_mix *mix = &group->mix[m];
        sb_text_clear(&text);
        sb_fit_mix_text(report, group, mix->row, &text);
        sb_table_cell(table, sb_text_get(&text));
        sb_table_real(table, "%.3f", mix->row->median_ms);
        sb_table_real(table, "%.3f", mix->predicted.point);
        add_interval(table, mix->predicted.lo, mix->predicted.hi);
        sb_table_real(table, "%+.1f %%", 100 * mix->off);
        sb_table_cellf(table, "%s%s%s",
                       fabs(mix->off) > SB_FIT_WRONG ? "wrong"
                       : mix->outside                ? "outside"
                                                     : "",
                       mix->outside && mix->in_jump ? ", " : "",
                       mix->in_jump ? "in a jump" : "");
    }
    if (group->mixes > 0)
        sb_table_print(table);
    print_verdict(group);
    sb_table_free(&table);
    sb_text_free(&text);
}

// --- crossings ----------------------------------------------------------------------------

static void print_crossing(const struct sb_crossing *crossing, const char *a,
                           const char *b)
{
    printf("%s is faster below, %s above %.3g triangles a pixel [%s%.3g, %s%.3g]\n",
           crossing->b_first ? b : a, crossing->b_first ? a : b, crossing->density,
           crossing->open_lo ? "<" : "", crossing->lo, crossing->open_hi ? ">" : "",
           crossing->hi);
}

static void print_series(const struct sb_fit_report *report,
                         const struct sb_crossing_series *series)
{
    const struct sb_axis *axis = &report->compared->axes->row[series->axis];
    const char *a = axis->values[series->value_a].name;
    const char *b = axis->values[series->value_b].name;
    struct sb_table *table = sb_table_new();
    struct sb_text text = {0};
    sb_fit_series_heading(report, series, &text);
    printf("\n%s: %s %s against %s\n", sb_text_get(&text), axis->name, a, b);
    sb_table_column(table, "triangles a pixel", true);
    for (int i = 0; i < 2; i++) {
        sb_text_clear(&text);
        sb_text_printf(&text, "%s ms", i ? b : a);
        sb_table_column(table, sb_text_get(&text), true);
    }
    sb_table_column(table, "ratio", true);
    sb_table_column(table, "interval", false);
    for (int i = 0; i < series->pairs; i++) {
        const struct sb_crossing_pair *pair = &series->pair[i];
        sb_table_real(table, "%.3g", pair->density);
        sb_table_real(table, "%.3f", pair->a->median_ms);
        sb_table_real(table, "%.3f", pair->b->median_ms);
        sb_table_real(table, "%.2f", pair->ratio);
        add_interval(table, pair->lo, pair->hi);
    }
    sb_table_print(table);
    for (int c = 0; c < series->crossings; c++)
        print_crossing(&series->crossing[c], a, b);
    if (series->crossings == 0)
        printf(
            "%s is faster in all of %.3g to %.3g triangles a pixel; where they cross was "
            "not measured\n",
            series->pair->ratio > 1 ? b : a, series->pair->density,
            series->pair[series->pairs - 1].density);
    sb_table_free(&table);
    sb_text_free(&text);
}

static void print_intervals(const struct sb_compared *compared)
{
    bool within = false, between = false;
    for (int i = 0; i < compared->rows.count; i++) {
        const char *kind = compared->rows.row[i].ci_kind;
        within |= kind && strcmp(kind, "ci95_within_run") == 0;
        between |= kind && strcmp(kind, "ci95_between_processes") == 0;
    }
    printf(
        "Intervals of prices: how far the rows scatter about the line (95 %%, Theil and "
        "Sen). Those of times and\ncounts of lights hold that and the rows' own%s%s%s\n",
        within || between ? ", " : "; the rows have none",
        between  ? "ci95_between_processes"
        : within ? "ci95_within_run"
                 : "",
        between  ? ""
        : within ? ": another process may differ by more"
                 : "");
}

void sb_fit_print(const struct sb_fit_report *report)
{
    const struct sb_fit *fit = &report->fit;
    printf("%s", about);
    print_intervals(report->compared);
    if (fit->without_time > 0)
        printf("%d rows have no valid time and are left out\n", fit->without_time);
    if (fit->count == 0)
        printf("\nno type of light has %d counts: there is nothing to fit\n",
               SB_FIT_COUNTS_MIN);
    for (int g = 0; g < fit->count; g++) {
        struct sb_text text = {0};
        sb_fit_heading(report, &fit->group[g], &text);
        printf("\n%s\n", sb_text_get(&text));
        print_floor(&fit->group[g]);
        print_prices(report, &fit->group[g]);
        print_lights(report, &fit->group[g]);
        print_mixes(report, &fit->group[g]);
        sb_text_free(&text);
    }
    for (int s = 0; s < report->crossings.count; s++)
        print_series(report, &report->crossings.series[s]);
}
