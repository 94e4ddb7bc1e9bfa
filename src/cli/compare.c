// shadebench compare: judges what earlier runs have written. Nothing is measured.
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "cli/compare.h"

bool sb_compare_varies(const struct sb_compared *compared, int axis)
{
    const struct sb_rows *rows = &compared->rows;
    struct sb_text first = {0}, other = {0};
    bool varies = false;
    sb_variant_value_text(compared->axes, rows->row[0].axes, axis, &first);
    for (int i = 1; i < rows->count && !varies; i++) {
        sb_text_clear(&other);
        sb_variant_value_text(compared->axes, rows->row[i].axes, axis, &other);
        varies = strcmp(sb_text_get(&first), sb_text_get(&other)) != 0;
    }
    sb_text_free(&first);
    sb_text_free(&other);
    return varies;
}

void sb_compare_add_axis(const struct sb_axes *axes, const struct sb_row *row, int axis,
                         struct sb_text *text)
{
    struct sb_text value = {0};
    sb_variant_value_text(axes, row->axes, axis, &value);
    if (value.length)
        sb_text_printf(text, " %s=%s", axes->row[axis].name, value.data);
    sb_text_free(&value);
}

static bool same(const char *a, const char *b)
{
    return strcmp(a ? a : "", b ? b : "") == 0;
}

void sb_compare_add_driver(const struct sb_compared *compared, const struct sb_row *row,
                           struct sb_text *text)
{
    bool one = true;
    for (int i = 0; i < compared->rows.count; i++) {
        const struct sb_row *other = &compared->rows.row[i];
        one &= same(row->renderer, other->renderer) &&
               same(row->version, other->version) &&
               same(row->timer_source, other->timer_source);
    }
    if (!one)
        sb_text_printf(text, " on %s, %s, timer %s", row->renderer ? row->renderer : "?",
                       row->version ? row->version : "?",
                       row->timer_source ? row->timer_source : "?");
}

json_t *sb_compare_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

// --- what to compare ---------------------------------------------------------------------

static const struct way {
    const char *option;
    size_t flag; // in struct sb_options
    int (*run)(const struct sb_options *options, struct sb_compared *compared);
} ways[] = {
    {"--pareto", offsetof(struct sb_options, pareto), sb_compare_pareto},
    {"--terms", offsetof(struct sb_options, terms), sb_compare_terms},
    {"--policies", offsetof(struct sb_options, policies), sb_compare_policies},
    {"--ablation", offsetof(struct sb_options, ablation), sb_compare_ablation},
};
enum { WAYS = sizeof ways / sizeof *ways };

static void list_ways(const char *before, const char *after, struct sb_text *text)
{
    for (int i = 0; i < WAYS; i++)
        sb_text_printf(text, "%s%s%s%s", i ? ", " : "", before, ways[i].option, after);
}

// What only `compare A B` has.
static const char *option_of_runs(const struct sb_options *options)
{
    return options->check       ? "--check"
           : options->force     ? "--force"
           : options->tolerance ? "--tolerance"
                                : NULL;
}

// SB_USAGE: neither two runs, nor a way and one.
static void fail_words(const struct sb_options *options, const struct way *way,
                       const char *valid, struct sb_error *err)
{
    if (way && options->word_count == 0)
        sb_fail(err, SB_USAGE, "compare %s wants a results folder or its summary.csv",
                way->option);
    else if (way)
        sb_fail(err, SB_USAGE, "compare %s takes one run; \"%s\" is one too many",
                way->option, options->word[1]);
    else if (options->word_count == 0)
        sb_fail(err, SB_USAGE, "compare what? valid: %s", valid);
    else if (options->word_count == 1)
        sb_fail(err, SB_USAGE, "compare %s with what? valid: %s", options->word[0],
                valid);
    else
        sb_fail(err, SB_USAGE, "compare takes two runs; \"%s\" is one too many",
                options->word[2]);
}

// Whether the options say what to compare. *way is NULL for two runs side by side.
static bool find_way(const struct sb_options *options, const struct way **way,
                     struct sb_error *err)
{
    struct sb_text valid = {0};
    const struct way *second = NULL;
    *way = NULL;
    for (int i = 0; i < WAYS; i++)
        if (*(const bool *)((const char *)options + ways[i].flag)) {
            second = *way ? &ways[i] : second;
            *way = *way ? *way : &ways[i];
        }
    sb_text_add(&valid, "compare A B, ");
    list_ways("compare ", " RESULTS", &valid);
    const bool good = !second && options->word_count == (*way ? 1 : 2);
    if (second)
        sb_fail(err, SB_USAGE, "%s or %s, not both", (*way)->option, second->option);
    else if (!good)
        fail_words(options, *way, sb_text_get(&valid), err);
    sb_text_free(&valid);
    if (good && *way && option_of_runs(options))
        return sb_fail(err, SB_USAGE, "%s goes with two runs, compare A B, not with %s",
                       option_of_runs(options), (*way)->option);
    return good;
}

int sb_cmd_compare(const struct sb_options *options, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_compared compared = {0};
    const struct way *way;
    int code;
    if (!find_way(options, &way, &err))
        code = sb_cli_fail(&err);
    else if (!way)
        code = sb_compare_runs(options);
    else if (!sb_results_load(options, options->word[0], &compared, &arena, &err))
        code = sb_cli_fail(&err);
    else
        code = way->run(options, &compared);
    sb_results_free(&compared);
    sb_arena_free(&arena);
    return code;
}
