// Rows that are held against others: policies against the program for all scenes, and variants that
// leave an effect out against the whole ones.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "analyse/policies.h"
#include "assemble/platform.h"
#include "cli/report.h"

static bool is_ablation(const struct sb_variant *variant)
{
    return !sb_platform_is_policy(variant);
}

// The rows that are held against another and that `wanted` wants. Returns how many.
static int choose(const struct sb_row *row, int count,
                  bool (*wanted)(const struct sb_variant *variant), struct sb_row *chosen)
{
    int chosen_count = 0;
    for (int i = 0; i < count; i++)
        if (row[i].against && wanted(row[i].axes))
            chosen[chosen_count++] = row[i];
    return chosen_count;
}

static void add_ratio(struct sb_table *table, const struct sb_row *row)
{
    if (isnan(row->against_ratio))
        sb_table_cell(table, NULL);
    else if (isnan(row->against_lo))
        sb_table_cellf(table, "%.2f", row->against_ratio);
    else
        sb_table_cellf(table, "%.2f [%.2f, %.2f]", row->against_ratio, row->against_lo,
                       row->against_hi);
}

static void add_payback(struct sb_table *table, double frames)
{
    if (isinf(frames))
        sb_table_cell(table, "never");
    else
        sb_table_real(table, "%.0f", isnan(frames) ? NAN : ceil(frames));
}

static void print_policies(const struct sb_axes *axes, const struct sb_row *row,
                           int count)
{
    struct sb_table *table = sb_table_new();
    struct sb_keys keys;
    static const char *const titles[] = {"programs",      "switches", "set-up ms",
                                         "frame ms",      "±",        "over uber",
                                         "payback frames"};
    bool checked = false;
    for (int i = 0; i < count; i++)
        checked |= !isnan(row[i].payback_check);
    sb_keys_make(&keys, axes, row, count);
    sb_keys_columns(&keys, table);
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++)
        sb_table_column(table, titles[i], true);
    if (checked)
        sb_table_column(table, "drawn", true);
    sb_table_column(table, "differs", true);
    for (int i = 0; i < count; i++) {
        sb_keys_cells(&keys, table, &row[i]);
        sb_table_real(table, "%.0f", (double)row[i].programs);
        sb_table_real(table, "%.0f", (double)row[i].switches);
        sb_table_real(table, "%.0f", sb_row_setup_ms(&row[i]));
        sb_report_level(table, &row[i]);
        add_ratio(table, &row[i]);
        add_payback(table, row[i].payback_frames);
        if (checked)
            sb_table_real(table, "%.2f", row[i].payback_check);
        sb_table_real(table, "%.2g", row[i].class_spread);
    }
    printf(
        "\nPolicies, over the faster program for all scenes (uber). Set-up: compiling, "
        "linking, and what the\nfirst draw takes longer. Differs: the picture's largest "
        "difference to that of the first policy.\n");
    sb_table_print(table);
    sb_table_free(&table);
}

// The implementation axes that were asked for, in words.
static void policy_text(const struct sb_axes *axes, const struct sb_variant *variant,
                        struct sb_text *text)
{
    struct sb_text value = {0};
    for (int a = 0; a < axes->count; a++) {
        sb_text_clear(&value);
        sb_variant_value_text(axes, variant, a, &value);
        if (axes->row[a].kind == SB_IMPLEMENTATION && sb_variant_given(variant, a) &&
            value.length)
            sb_text_printf(text, "%s%s=%s", text->length ? "," : "", axes->row[a].name,
                           value.data);
    }
    sb_text_free(&value);
}

static void add_total(struct sb_table *table, const struct sb_axes *axes,
                      const struct sb_policy_total *total)
{
    struct sb_text policy = {0};
    policy_text(axes, total->first->axes, &policy);
    sb_table_cell(table, sb_text_get(&policy));
    sb_table_real(table, "%.0f", total->rows);
    sb_table_real(table, "%.0f", total->programs);
    sb_table_real(table, "%.0f", total->setup_ms);
    sb_table_real(table, "%.0f", total->uber_setup_ms);
    sb_table_real(table, "%.2f", total->ratio);
    add_payback(table, total->payback_frames);
    sb_text_free(&policy);
}

static void print_totals(const struct sb_axes *axes, const struct sb_row *row, int count)
{
    static const char *const titles[] = {"scenes",    "programs",
                                         "set-up ms", "uber's set-up ms",
                                         "over uber", "payback frames"};
    struct sb_policy_total *total = sb_alloc(((size_t)count + 1) * sizeof *total);
    const int totals = sb_policy_totals(axes, row, count, sb_platform_is_policy, total);
    struct sb_table *table = sb_table_new();
    sb_table_column(table, "policy", false);
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++)
        sb_table_column(table, titles[i], true);
    bool several = false;
    for (int i = 0; i < totals; i++) {
        add_total(table, axes, &total[i]);
        several |= total[i].rows > 1;
    }
    if (several) {
        printf(
            "\nAll scenes together, each shown for as many frames; over uber: geometric "
            "mean.\n");
        sb_table_print(table);
    }
    sb_table_free(&table);
    free(total);
}

void sb_report_policies(const struct sb_axes *axes, const struct sb_row *row, int count)
{
    struct sb_row *chosen = sb_alloc(((size_t)count + 1) * sizeof *chosen);
    const int chosen_count = choose(row, count, sb_platform_is_policy, chosen);
    if (chosen_count > 0) {
        print_policies(axes, chosen, chosen_count);
        print_totals(axes, row, count);
    }
    free(chosen);
}

static void print_ablation(const struct sb_axes *axes, const struct sb_row *all,
                           int all_count, const struct sb_row *row, int count)
{
    struct sb_table *table = sb_table_new();
    struct sb_keys keys;
    static const char *const titles[] = {"whole ms",   "without ms", "saved ms",
                                         "over whole", "max err",    "whole's",
                                         "FLIP",       "whole's",    "pixels a step off"};
    sb_keys_make(&keys, axes, row, count);
    sb_keys_columns(&keys, table);
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++)
        sb_table_column(table, titles[i], true);
    for (int i = 0; i < count; i++) {
        const struct sb_row *whole = sb_row_against(all, all_count, &row[i]);
        sb_keys_cells(&keys, table, &row[i]);
        sb_table_real(table, "%.3f", whole ? whole->median_ms : NAN);
        sb_table_real(table, "%.3f", row[i].median_ms);
        sb_table_real(table, "%.3f",
                      whole ? whole->median_ms * (1 - row[i].against_ratio) : NAN);
        add_ratio(table, &row[i]);
        sb_table_real(table, "%.2g", row[i].max_err);
        sb_table_real(table, "%.2g", whole ? whole->max_err : NAN);
        sb_table_real(table, "%.2g", row[i].flip_mean);
        sb_table_real(table, "%.2g", whole ? whole->flip_mean : NAN);
        sb_table_real(table, "%.1f %%", 100 * row[i].jnd1_share);
    }
    printf(
        "\nEach effect left out alone: what it costs, and who would see it go. A step is "
        "1/255 in linear light;\nerrors are against the reference, which leaves nothing "
        "out.\n");
    sb_table_print(table);
    sb_table_free(&table);
}

void sb_report_ablation(const struct sb_axes *axes, const struct sb_row *row, int count)
{
    struct sb_row *chosen = sb_alloc(((size_t)count + 1) * sizeof *chosen);
    const int chosen_count = choose(row, count, is_ablation, chosen);
    if (chosen_count > 0)
        print_ablation(axes, row, count, chosen, chosen_count);
    free(chosen);
}
