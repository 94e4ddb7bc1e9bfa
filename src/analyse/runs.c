#include "analyse/runs.h"

#include <math.h>
#include <string.h>

#include "analyse/alike.h"
#include "analyse/pareto.h"
#include "analyse/runs_match.h"
#include "stats/unpaired.h"

const struct sb_run_verdict_row sb_run_verdict_rows[SB_RUN_VERDICT_COUNT] = {
    [SB_RUN_HELPED] = {"helped", "faster by more than the tolerance"},
    [SB_RUN_HURT] = {"hurt", "slower by more than the tolerance"},
    [SB_RUN_UNCHANGED] = {"unchanged", "the same within the tolerance"},
    [SB_RUN_UNCLEAR] = {"unclear", "the interval is too wide, or missing"},
    [SB_RUN_UNTIMED] = {"untimed", "neither has a time"},
    [SB_RUN_LOST] = {"lost", "A has a time, B none"},
    [SB_RUN_GAINED] = {"gained", "B has a time, A none"},
    [SB_RUN_REFUSED] = {"refused", "measured under other conditions"},
};

// --- conditions -----------------------------------------------------------------------------

struct difference {
    struct sb_text text;
    bool unlike;
};

static const char *or_none(const char *word)
{
    return word && *word ? word : "none";
}

static void add_difference(struct difference *difference, const char *name, const char *a,
                           const char *b, bool unlike)
{
    if (strcmp(or_none(a), or_none(b)) == 0)
        return;
    sb_text_printf(&difference->text, "%s%s %s | %s", difference->text.length ? "; " : "",
                   name, or_none(a), or_none(b));
    difference->unlike |= unlike;
}

static const char *fact_of(const struct sb_run_side *side, const char *name)
{
    for (int i = 0; i < side->fact_count; i++)
        if (strcmp(side->fact[i].name, name) == 0)
            return side->fact[i].value;
    return NULL;
}

static void compare_facts(const struct sb_runs_params *params,
                          struct difference *difference)
{
    const struct sb_run_side *a = &params->a, *b = &params->b;
    if (!a->fact_count || !b->fact_count)
        return;
    for (int i = 0; i < a->fact_count; i++)
        add_difference(difference, a->fact[i].name, a->fact[i].value,
                       fact_of(b, a->fact[i].name), true);
    for (int i = 0; i < b->fact_count; i++)
        if (!fact_of(a, b->fact[i].name))
            add_difference(difference, b->fact[i].name, NULL, b->fact[i].value, true);
}

// What a row that failed may have left undecided: the driver's version of GLSL, a storage.
static bool is_open(const struct sb_row *row, const char *word)
{
    return !sb_row_has_time(row) && strcmp(word, "auto") == 0;
}

// A run whose suite does not declare an axis has no value there, not any.
static bool is_lacking(const struct sb_run_words *words, int axis)
{
    return words->axis[axis] < 0;
}

static void compare_axes(const struct sb_run_match *match, int i, int j,
                         struct difference *difference)
{
    for (int k = 0; k < match->axis_count; k++) {
        const char *x = sb_run_word(&match->a, i, k), *y = sb_run_word(&match->b, j, k);
        const bool moot = (!*x && !is_lacking(&match->a, k)) ||
                          (!*y && !is_lacking(&match->b, k)); // goes with every value
        if (!moot && !is_open(&match->a.side->row[i], x) &&
            !is_open(&match->b.side->row[j], y))
            add_difference(difference, match->axis[k]->name, x, y,
                           sb_pareto_keeps_apart(match->axis[k]));
    }
}

static void compare_conditions(const struct sb_runs_params *params,
                               const struct sb_run_match *match, int i, int j,
                               struct difference *difference)
{
    const struct sb_row *a = &params->a.row[i], *b = &params->b.row[j];
    add_difference(difference, "scene", a->scene, b->scene, true);
    add_difference(difference, "renderer", a->renderer, b->renderer, true);
    add_difference(difference, "version", a->version, b->version, true);
    add_difference(difference, "timer", a->timer_source, b->timer_source, true);
    compare_axes(match, i, j, difference);
    if (a->input_hash && b->input_hash) // a row that failed has none
        add_difference(difference, "input hash", a->input_hash, b->input_hash, true);
    compare_facts(params, difference);
}

// --- verdicts -------------------------------------------------------------------------------

static int processes_of(const struct sb_row *row)
{
    return row->processes > 1 ? (int)row->processes : 1;
}

static struct sb_interval level_of(const struct sb_row *row)
{
    return (struct sb_interval){row->median_ms, row->ci_lo_ms, row->ci_hi_ms,
                                processes_of(row)};
}

static enum sb_run_verdict judge(const struct sb_interval *ratio, double tolerance)
{
    const double most = 1 + tolerance, least = 1 / most;
    if (isnan(ratio->lo) || isnan(ratio->hi))
        return SB_RUN_UNCLEAR;
    return ratio->lo > most                          ? SB_RUN_HURT
           : ratio->hi < least                       ? SB_RUN_HELPED
           : ratio->lo >= least && ratio->hi <= most ? SB_RUN_UNCHANGED
                                                     : SB_RUN_UNCLEAR;
}

static void compare_times(struct sb_run_pair *pair, double tolerance)
{
    const bool timed_a = sb_row_has_time(pair->a), timed_b = sb_row_has_time(pair->b);
    if (!timed_a || !timed_b) {
        pair->verdict = timed_a ? SB_RUN_LOST : timed_b ? SB_RUN_GAINED : SB_RUN_UNTIMED;
        return;
    }
    const struct sb_interval a = level_of(pair->a), b = level_of(pair->b);
    pair->between = a.n > 1 || b.n > 1;
    pair->ratio =
        pair->between ? sb_unpaired_between(&a, &b, 0.95) : sb_unpaired_within(&a, &b);
    pair->verdict = judge(&pair->ratio, tolerance);
}

static enum sb_run_change compare_errors(const struct sb_row *a, const struct sb_row *b,
                                         double tolerance)
{
    if (a->nonfinite != SB_NO_COUNT && b->nonfinite != SB_NO_COUNT &&
        a->nonfinite != b->nonfinite)
        return b->nonfinite > a->nonfinite ? SB_RUN_WORSE : SB_RUN_BETTER;
    // Comparisons with NAN are false.
    return b->max_err > a->max_err * (1 + tolerance)   ? SB_RUN_WORSE
           : a->max_err > b->max_err * (1 + tolerance) ? SB_RUN_BETTER
                                                       : SB_RUN_SAME;
}

static int exit_code_of(const struct sb_row *row)
{
    const enum sb_status status = row->status ? sb_status_find(row->status) : SB_INTERNAL;
    return sb_status_rows[status == SB_STATUS_COUNT ? SB_INTERNAL : status].exit_code;
}

static enum sb_run_change compare_statuses(const struct sb_row *a, const struct sb_row *b)
{
    const int before = exit_code_of(a), after = exit_code_of(b);
    if (before == after)
        return SB_RUN_SAME;
    // The order of exit codes puts "interrupted" behind what failed, and 0 last.
    return sb_exit_code_worse(before, after) == after ? SB_RUN_WORSE : SB_RUN_BETTER;
}

static enum sb_run_code compare_codes(const char *a, const char *b)
{
    if (!a || !b)
        return SB_RUN_CODE_UNKNOWN;
    return strcmp(a, b) == 0 ? SB_RUN_CODE_SAME : SB_RUN_CODE_CHANGED;
}

static void compare_pair(const struct sb_runs_params *params,
                         const struct sb_run_match *match, int i, int j,
                         struct sb_run_pair *pair, struct sb_arena *arena)
{
    struct difference difference = {0};
    pair->b = &params->b.row[j];
    compare_conditions(params, match, i, j, &difference);
    pair->differs = sb_arena_strdup(arena, sb_text_get(&difference.text));
    pair->unlike = difference.unlike;
    sb_text_free(&difference.text);
    pair->source = compare_codes(pair->a->source_hash, pair->b->source_hash);
    pair->binary = compare_codes(pair->a->binary_hash, pair->b->binary_hash);
    pair->error = compare_errors(pair->a, pair->b, params->tolerance);
    pair->status = compare_statuses(pair->a, pair->b);
    if (pair->unlike && !params->force)
        pair->verdict = SB_RUN_REFUSED;
    else
        compare_times(pair, params->tolerance);
}

// A variant that is gone, or has no time any more, is no success.
static bool is_missed(const struct sb_run_pair *pair)
{
    return pair->verdict == SB_RUN_LOST && exit_code_of(pair->a) == 0;
}

static void count_pair(struct sb_runs *runs, const struct sb_run_pair *pair)
{
    runs->of[pair->verdict]++;
    runs->worse += is_missed(pair);
    if (!pair->a || !pair->b || pair->verdict == SB_RUN_REFUSED)
        return;
    runs->comparable++;
    runs->within += !isnan(pair->ratio.point) && !pair->between;
    runs->between += pair->between;
    runs->worse +=
        !is_missed(pair) && (pair->verdict == SB_RUN_HURT ||
                             pair->error == SB_RUN_WORSE || pair->status == SB_RUN_WORSE);
    runs->moved += pair->source == SB_RUN_CODE_SAME &&
                   (pair->verdict == SB_RUN_HURT || pair->verdict == SB_RUN_HELPED);
}

void sb_runs_compare(const struct sb_runs_params *params, struct sb_runs *runs)
{
    const int room = params->a.count + params->b.count;
    const struct sb_run_pair empty = {.ratio = {NAN, NAN, NAN, 0}, .differs = ""};
    struct sb_run_match match;
    sb_run_match_make(&match, &params->a, &params->b);
    runs->pair = sb_arena_alloc(&runs->arena, ((size_t)room + 1) * sizeof *runs->pair);
    bool *taken = sb_arena_alloc(&runs->arena, (size_t)params->b.count + 1);
    for (int i = 0; i < params->a.count; i++) {
        struct sb_run_pair *pair = &runs->pair[runs->count++];
        *pair = empty;
        pair->a = &params->a.row[i];
        pair->verdict = SB_RUN_LOST;
        if (match.partner[i] < 0)
            continue;
        taken[match.partner[i]] = true;
        compare_pair(params, &match, i, match.partner[i], pair, &runs->arena);
    }
    for (int j = 0; j < params->b.count; j++)
        if (!taken[j]) {
            struct sb_run_pair *pair = &runs->pair[runs->count++];
            *pair = empty;
            pair->b = &params->b.row[j];
            pair->verdict = SB_RUN_GAINED;
        }
    for (int i = 0; i < runs->count; i++)
        count_pair(runs, &runs->pair[i]);
    sb_run_match_free(&match);
}

void sb_runs_free(struct sb_runs *runs)
{
    sb_arena_free(&runs->arena);
    *runs = (struct sb_runs){0};
}
