// Times the pairs of a list of prices: an ordinary run of their variants, and its samples read back.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "cases/price.h"
#include "measure/run.h"
#include "measure/task.h"
#include "results/csv.h"
#include "stats/paired.h"

// --- the plan -----------------------------------------------------------------------------

static int find_entry(const struct sb_suite *suite, const struct sb_variant *variant)
{
    for (int i = 0; i < suite->entry_count; i++)
        if (sb_variant_equal(&suite->axes, &suite->entry[i].variant, variant))
            return i;
    return -1;
}

// Every variant once, pair after pair.
static void make_suite(const struct sb_prices *prices,
                       const struct sb_prices_params *params, struct sb_suite *suite)
{
    struct sb_text id = {0};
    suite->axes = *sb_axes_builtin();
    suite->name = "guards";
    suite->about = "What do the guards of the hard cases cost?";
    sb_measure_defaults(&suite->measure);
    suite->measure.seed = params->seed;
    suite->measure.rounds = params->rounds;
    suite->measure.budget = params->budget;
    // All rounds for all: a pair needs both, and one look at the end needs no correction.
    suite->measure.first_look = params->rounds;
    suite->measure.span = 0;
    suite->entry = sb_arena_alloc(
        &suite->arena, (size_t)prices->count * SB_CASE_FORM_COUNT * sizeof *suite->entry);
    for (int i = 0; i < prices->count; i++)
        for (int form = 0; form < SB_CASE_FORM_COUNT; form++) {
            const struct sb_variant *variant = &prices->row[i].variant[form];
            if (find_entry(suite, variant) >= 0)
                continue;
            sb_text_clear(&id);
            sb_variant_id(&suite->axes, variant, &id);
            suite->entry[suite->entry_count++] = (struct sb_plan_entry){
                .scene = params->scene,
                .variant = *variant,
                .id = sb_arena_strdup(&suite->arena, sb_text_get(&id)),
            };
        }
    sb_text_free(&id);
}

// --- its samples --------------------------------------------------------------------------

struct samples {
    struct sb_csv csv;
    struct sb_sample_row *row;
    int count;
};

static bool read_samples(const char *dir, struct samples *samples, struct sb_error *err)
{
    struct sb_arena arena = {0};
    bool good = sb_csv_read(sb_path_join(&arena, dir, "samples.csv"), &samples->csv, err);
    sb_arena_free(&arena);
    if (!good)
        return false;
    samples->row = sb_alloc(((size_t)samples->csv.row_count + 1) * sizeof *samples->row);
    for (int line = 1; good && line < samples->csv.row_count; line++) {
        struct sb_sample_row *row = &samples->row[samples->count++];
        sb_sample_row_init(row);
        good = sb_csv_get(&samples->csv, line, sb_sample_columns, sb_sample_column_count,
                          row, err);
    }
    return good;
}

// A variant's time in each round; NAN where it has none.
static void times_of(const struct samples *samples, const char *id, double *ms,
                     int rounds)
{
    for (int i = 0; i < rounds; i++)
        ms[i] = NAN;
    for (int i = 0; i < samples->count; i++) {
        const struct sb_sample_row *row = &samples->row[i];
        if (strcmp(row->variant, id) == 0 && row->round < rounds)
            ms[row->round] = sb_sample_frame_ms(row);
    }
}

static void price_pair(const struct samples *samples, const char *naive,
                       const char *robust, int rounds, struct sb_price *price)
{
    const size_t room = (size_t)rounds;
    double *a = sb_alloc(3 * room * sizeof *a), *b = a + room, *scratch = b + room;
    int n = 0;
    times_of(samples, naive, a, rounds);
    times_of(samples, robust, b, rounds);
    for (int i = 0; i < rounds; i++) {
        a[n] = a[i];
        b[n] = b[i];
        n += !isnan(a[i]) && !isnan(b[i]);
    }
    if (n > 0)
        price->ratio = sb_paired_ratio(a, b, n, 0.95, scratch);
    free(a);
}

// What stands in the rows of the two that a reader of the price should know.
static void note_rows(const struct sb_run_result *result, const int entry[],
                      struct sb_price *price)
{
    for (int form = 0; form < SB_CASE_FORM_COUNT; form++) {
        const struct sb_row *row = &result->row[entry[form]];
        const bool said = form > 0 &&
                          strcmp(row->status, result->row[entry[0]].status) == 0 &&
                          isnan(price->ratio.point) == false;
        if (strcmp(row->status, "ok") == 0 || said)
            continue;
        sb_text_printf(&price->note, "%s%s: %s", price->note.length ? "; " : "",
                       sb_case_form_names[form], row->status);
        if (isnan(price->ratio.point) && row->note)
            sb_text_printf(&price->note, " (%s)", row->note);
    }
    const char *const *hash[] = {&result->row[entry[0]].binary_hash,
                                 &result->row[entry[1]].binary_hash};
    if (*hash[0] && *hash[1] && strcmp(*hash[0], *hash[1]) == 0)
        sb_text_printf(&price->note, "%sboth compile to the same code",
                       price->note.length ? "; " : "");
}

static bool evaluate(struct sb_prices *prices, const struct sb_suite *suite,
                     const struct sb_run_result *result, const char *dir,
                     struct sb_error *err)
{
    struct samples samples = {0};
    const bool good = read_samples(dir, &samples, err);
    for (int i = 0; good && i < prices->count; i++) {
        struct sb_price *price = &prices->row[i];
        const int entry[] = {find_entry(suite, &price->variant[SB_CASE_NAIVE]),
                             find_entry(suite, &price->variant[SB_CASE_ROBUST])};
        price_pair(&samples, suite->entry[entry[0]].id, suite->entry[entry[1]].id,
                   (int)suite->measure.rounds, price);
        note_rows(result, entry, price);
    }
    snprintf(prices->timer, sizeof prices->timer, "%s", result->row[0].timer_source);
    prices->timer_error = result->row[0].timer_error;
    prices->interrupted = result->interrupted;
    prices->exit_code = result->exit_code;
    free(samples.row);
    sb_csv_free(&samples.csv);
    return good;
}

bool sb_prices_measure(struct sb_prices *prices, const struct sb_prices_params *params,
                       struct sb_error *err)
{
    struct sb_suite suite = {0};
    struct sb_run_result result = {0};
    make_suite(prices, params, &suite);
    const struct sb_run_params run = {
        .suite = &suite,
        .driver = {.timer = params->timer},
        .examined = params->driver,
        .data_dir = params->data_dir,
        .shaders = params->shaders,
        .dir = params->dir,
        .arguments = params->arguments,
    };
    const bool good =
        sb_run(&run, &result, err) && evaluate(prices, &suite, &result, params->dir, err);
    sb_run_result_free(&result);
    sb_suite_free(&suite);
    return good;
}
