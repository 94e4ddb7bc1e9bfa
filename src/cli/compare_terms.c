// compare --terms: the price of each term's precision, a table for each group of rows that
// differ in their terms only.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "analyse/terms.h"
#include "cli/compare.h"
#include "cli/table.h"

static const struct sb_row *any_row(const struct sb_term_prices *group)
{
    const struct sb_row *row = group->high ? group->high : group->low;
    for (int t = 0; !row && t < group->count; t++)
        row = group->price[t].lowered.row ? group->price[t].lowered.row
                                          : group->price[t].raised.row;
    return row;
}

static bool is_priced(const struct sb_compared *compared,
                      const struct sb_term_prices *group, int axis)
{
    for (int t = 0; t < group->count; t++)
        if (group->price[t].axis == axis)
            return true;
    const struct sb_axis *row = &compared->axes->row[axis];
    for (int v = 0; v < row->value_count; v++)
        if (*row->values[v].sets)
            return true;
    return false;
}

// The scene, and those of the axes that the group's rows have in common and other groups not.
static void add_heading(const struct sb_compared *compared, const struct sb_terms *terms,
                        const struct sb_term_prices *group, struct sb_text *text)
{
    const struct sb_row *row = any_row(group);
    sb_text_add(text, row->scene);
    for (int a = 0; a < compared->axes->count; a++) {
        bool same = true;
        for (int g = 0; g < terms->count; g++)
            same &= any_row(&terms->group[g])->axes->value[a] == row->axes->value[a];
        if (!same && !is_priced(compared, group, a))
            sb_compare_add_axis(compared->axes, row, a, text);
    }
    sb_compare_add_driver(compared, row, text);
}

static void print_base(const char *word, const struct sb_row *row)
{
    if (!row) {
        printf("all %s: not in the file\n", word);
        return;
    }
    printf("all %s:", word);
    if (!isnan(row->median_ms))
        printf(" %.3f ms,", row->median_ms);
    if (isnan(row->max_err))
        printf(" no errors (%s)\n", row->status);
    else
        printf(" max error %.2g = %.2g/255, FLIP %.2g\n", row->max_err,
               255 * row->max_err, row->flip_mean);
}

static void add_change(struct sb_table *table, const struct sb_term_change *change)
{
    char text[96] = "";
    if (!isnan(change->time_lo))
        snprintf(text, sizeof text, "%.2f [%.2f, %.2f]%s", change->time, change->time_lo,
                 change->time_hi, change->paired ? " " : "*");
    else if (!isnan(change->time))
        snprintf(text, sizeof text, "%.2f%s", change->time, change->paired ? " " : "*");
    sb_table_cell(table, text);
    sb_table_real(table, "%.2g", change->max_err);
    sb_table_real(table, "%.2g", 255 * change->max_err);
    sb_table_real(table, "%.2g", change->flip_mean);
}

static void print_group(const struct sb_compared *compared, const struct sb_terms *terms,
                        const struct sb_term_prices *group)
{
    struct sb_text text = {0};
    add_heading(compared, terms, group, &text);
    printf("\n%s\n", sb_text_get(&text));
    print_base(group->high_word, group->high);
    print_base(group->low_word, group->low);
    struct sb_table *table = sb_table_new();
    sb_table_column(table, "term", false);
    for (int i = 0; i < 2; i++) {
        sb_text_clear(&text);
        sb_text_printf(&text, "alone %s: time", i ? group->high_word : group->low_word);
        sb_table_column(table, sb_text_get(&text), true);
        sb_table_column(table, "max err", true);
        sb_table_column(table, "of 255", true);
        sb_table_column(table, "FLIP", true);
    }
    sb_table_column(table, "verdict", false);
    for (int t = 0; t < group->count; t++) {
        const struct sb_term_price *price = &group->price[t];
        sb_table_cell(table, compared->axes->row[price->axis].name);
        add_change(table, &price->lowered);
        add_change(table, &price->raised);
        sb_table_cell(table, sb_term_verdict_words[price->verdict]);
    }
    sb_table_print(table);
    sb_table_free(&table);
    sb_text_free(&text);
}

static void print_text(const struct sb_compared *compared, const struct sb_terms *terms)
{
    printf(
        "A term alone low is compared with all high, alone high with all low.\n"
        "Times are ratios of pairs of one round with their intervals; with *, quotients "
        "of medians,\nin brackets from the least to the largest quotient of their "
        "intervals.\n%s",
        sb_term_rules);
    for (int g = 0; g < terms->count; g++)
        print_group(compared, terms, &terms->group[g]);
}

static json_t *change_json(const struct sb_term_change *change)
{
    if (!change->row)
        return json_null();
    json_t *object =
        json_pack("{ssssso}", "variant", change->row->variant, "status",
                  change->row->status, "time", sb_compare_number(change->time));
    json_object_set_new(object, "time_lo", sb_compare_number(change->time_lo));
    json_object_set_new(object, "time_hi", sb_compare_number(change->time_hi));
    json_object_set_new(object, "paired", json_boolean(change->paired));
    json_object_set_new(object, "max_err", sb_compare_number(change->max_err));
    json_object_set_new(object, "flip_mean", sb_compare_number(change->flip_mean));
    return object;
}

static json_t *terms_json(const struct sb_compared *compared,
                          const struct sb_terms *terms)
{
    json_t *groups = json_array();
    for (int g = 0; g < terms->count; g++) {
        const struct sb_term_prices *group = &terms->group[g];
        struct sb_text heading = {0};
        json_t *list = json_array();
        for (int t = 0; t < group->count; t++) {
            const struct sb_term_price *price = &group->price[t];
            json_array_append_new(list, json_pack("{sssssoso}", "term",
                                                  compared->axes->row[price->axis].name,
                                                  "verdict",
                                                  sb_term_verdict_words[price->verdict],
                                                  "lowered", change_json(&price->lowered),
                                                  "raised", change_json(&price->raised)));
        }
        add_heading(compared, terms, group, &heading);
        json_array_append_new(
            groups, json_pack("{ssssssss?ss?so}", "group", sb_text_get(&heading),
                              "high_word", group->high_word, "low_word", group->low_word,
                              "high", group->high ? group->high->variant : NULL, "low",
                              group->low ? group->low->variant : NULL, "terms", list));
        sb_text_free(&heading);
    }
    return json_pack("{ssso}", "file", compared->path, "groups", groups);
}

int sb_compare_terms(const struct sb_options *options, struct sb_compared *compared)
{
    struct sb_error err = {0};
    struct sb_terms terms = {0};
    int code = 0;
    sb_terms_price(compared->axes, compared->rows.row, compared->rows.count, &terms);
    if (terms.count == 0) {
        sb_fail(
            &err, SB_BAD_INPUT,
            "%s: no row has one term lowered or raised alone beside a row of all high "
            "or all low; shadebench run terms measures such",
            compared->path);
        code = sb_cli_fail(&err);
    } else if (options->json) {
        sb_cli_print_json(terms_json(compared, &terms));
    } else {
        print_text(compared, &terms);
    }
    sb_terms_free(&terms);
    return code;
}
