#include <math.h>
#include <string.h>

#include "stats/gate.h"
#include "stats/paired.h"
#include "stats/power.h"
#include "stats/series.h"

const struct sb_gate_verdict_row sb_gate_verdict_rows[] = {
    [SB_GATE_OPEN] = {"open", "not decided yet: more pairs are needed"},
    [SB_GATE_PASS] = {"pass", "slower by less than the tolerance, if at all"},
    [SB_GATE_IMPROVED] = {"improved", "faster by more than the tolerance"},
    [SB_GATE_CANDIDATE] = {"candidate",
                           "slower by more than the tolerance, not yet confirmed"},
    [SB_GATE_REGRESSION] = {"regression",
                            "slower by more than the tolerance, in a fresh process too"},
    [SB_GATE_NOT_CONFIRMED] = {"not-confirmed",
                               "a candidate that a fresh process did not confirm"},
    [SB_GATE_INCONCLUSIVE] = {"inconclusive",
                              "the pairs ran out before either side was clear"},
    [SB_GATE_SKIPPED] = {"skipped", "not measured: base and head are the same program"},
    [SB_GATE_INVALID] = {"invalid", "could not be measured, or not so that it counts"},
};

enum sb_gate_verdict sb_gate_verdict_find(const char *word)
{
    int verdict = 0;
    while (verdict < SB_GATE_VERDICT_COUNT &&
           strcmp(word, sb_gate_verdict_rows[verdict].word) != 0)
        verdict++;
    return verdict;
}

struct sb_gate_rule sb_gate_rule_default(int variants)
{
    return (struct sb_gate_rule){.tolerance = 0.02,
                                 .alpha = 0.05,
                                 .variants = variants,
                                 .looks = {.first = 15, .rounds = 240},
                                 .confirm_pairs = 120};
}

static const double too_dependent = 0.2;
static const double power = 0.9;

static double mean(const double *values, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += values[i];
    return sum / n;
}

// Averages of blocks of d, in its place; how many. The last block takes what is left.
static int average_blocks(double *d, int n)
{
    const int blocks = n < SB_GATE_BLOCK ? 1 : n / SB_GATE_BLOCK;
    for (int block = 0; block < blocks; block++) {
        const int begin = block * SB_GATE_BLOCK;
        d[block] = mean(d + begin, block < blocks - 1 ? SB_GATE_BLOCK : n - begin);
    }
    return blocks;
}

// The same of the pairs of each process.
static int average_processes(double *d, const int *process, int n)
{
    int count = 0;
    for (int begin = 0, end; begin < n; begin = end) {
        for (end = begin + 1; end < n && process[end] == process[begin];)
            end++;
        d[count++] = mean(d + begin, end - begin);
    }
    return count;
}

// That of d without what the order within the pairs does, which is turned from pair to pair: it sets
// neighbours apart, and would hide that they depend on each other. Room for 3 n values.
static double autocorrelation(const double *d, int n, double *scratch)
{
    double *rest = scratch, *turn = scratch + n;
    for (int first = 0; first < 2; first++) {
        int count = 0;
        for (int i = first; i < n; i += 2)
            turn[count++] = d[i];
        sb_sort_doubles(turn, count);
        const double middle = count ? sb_median(turn, count) : 0;
        for (int i = first; i < n; i += 2)
            rest[i] = d[i] - middle;
    }
    return sb_rank_autocorrelation(rest, n, scratch + n);
}

// The interval of averaged d, as of head and base that have these ratios.
static struct sb_interval block_ratio(const double *d, int n, double *scratch)
{
    double *base = scratch, *head = scratch + n;
    for (int i = 0; i < n; i++) {
        base[i] = 1;
        head[i] = exp(d[i]);
    }
    return sb_paired_ratio(base, head, n, 0.95, scratch + 2 * (size_t)n);
}

// The least effect beyond the tolerance that is a candidate after so many units, and then confirmed,
// with that power: between what the harder of the two finds alone, and what both find so often
// that together they do.
static double least_found(const struct sb_gate_rule *rule,
                          const struct sb_gate_reading *reading, int units)
{
    const double spread = reading->spread, both = sqrt(power);
    const int confirming = rule->confirm_pairs / (reading->blocked ? SB_GATE_BLOCK : 1);
    const double first = sb_detectable_effect(spread, units, reading->alpha, power);
    double least =
        fmax(first, sb_detectable_effect(spread, confirming, rule->alpha, power));
    double most = fmax(sb_detectable_effect(spread, units, reading->alpha, both),
                       sb_detectable_effect(spread, confirming, rule->alpha, both));
    for (int step = 0; step < 50; step++) {
        const double effect = (least + most) / 2;
        const double found = sb_detection_power(spread, units, reading->alpha, effect) *
                             sb_detection_power(spread, confirming, rule->alpha, effect);
        *(found < power ? &least : &most) = effect;
    }
    return most;
}

// All but verdict, looks, and the levels. False where a time is none.
static bool read_pairs(const struct sb_gate_rule *rule, const double *base,
                       const double *head, const int *process, int n, double *scratch,
                       struct sb_gate_reading *reading)
{
    double *d = scratch, *rest = scratch + n;
    for (int i = 0; i < n; i++) {
        if (!(base[i] > 0 && head[i] > 0 && isfinite(base[i]) && isfinite(head[i])))
            return false;
        d[i] = log(head[i] / base[i]);
        reading->ties += !(head[i] < base[i] || head[i] > base[i]);
    }
    reading->autocorrelation = autocorrelation(d, n, rest);
    // Not where neighbours are opposed: ranks then claim too little, which costs no safety.
    reading->blocked = process || reading->autocorrelation > too_dependent;
    const int units = process            ? average_processes(d, process, n)
                      : reading->blocked ? average_blocks(d, n)
                                         : n;
    reading->spread = sb_robust_spread(d, units, rest);
    const double limit = log1p(rule->tolerance), mirrored = log1p(-rule->tolerance);
    reading->p_slower = sb_signed_rank_p(d, units, limit, SB_GREATER, rest);
    reading->p_within = sb_signed_rank_p(d, units, limit, SB_LESS, rest);
    reading->p_faster = sb_signed_rank_p(d, units, mirrored, SB_LESS, rest);
    reading->ratio = reading->blocked ? block_ratio(d, units, rest)
                                      : sb_paired_ratio(base, head, n, 0.95, rest);
    reading->mde = rule->tolerance + least_found(rule, reading, units);
    return true;
}

static struct sb_gate_reading nothing_read(int n)
{
    return (struct sb_gate_reading){.verdict = SB_GATE_OPEN,
                                    .n = n,
                                    .ratio = {NAN, NAN, NAN, 0},
                                    .p_slower = NAN,
                                    .p_within = NAN,
                                    .p_faster = NAN,
                                    .spread = NAN,
                                    .mde = NAN,
                                    .autocorrelation = NAN};
}

static enum sb_gate_verdict decide(const struct sb_gate_reading *reading, bool last)
{
    if (reading->p_slower < reading->alpha)
        return SB_GATE_CANDIDATE;
    if (reading->p_within < reading->alpha_within)
        return reading->p_faster < reading->alpha ? SB_GATE_IMPROVED : SB_GATE_PASS;
    return last ? SB_GATE_INCONCLUSIVE : SB_GATE_OPEN;
}

struct sb_gate_reading sb_gate_read(const struct sb_gate_rule *rule, const double *base,
                                    const double *head, const int *process, int n,
                                    bool over, double *scratch)
{
    const int pairs = n < rule->looks.rounds ? n : rule->looks.rounds;
    const bool last = over || pairs == rule->looks.rounds;
    const bool look = pairs > 0 && (over || sb_look_due(&rule->looks, pairs));
    struct sb_gate_reading reading = nothing_read(pairs);
    reading.alpha_within = rule->alpha / sb_look_count(&rule->looks);
    reading.alpha = reading.alpha_within / rule->variants;
    // Looks before this one, and this one: those of a schedule that ends here.
    const struct sb_looks until = {rule->looks.first, pairs};
    reading.looks = sb_look_count(&until) - !look;
    reading.alpha_spent = reading.alpha * reading.looks;
    if (pairs > 0 && !read_pairs(rule, base, head, process, pairs, scratch, &reading))
        reading.verdict = SB_GATE_INVALID;
    else if (look || over)
        reading.verdict = decide(&reading, last);
    return reading;
}

struct sb_gate_reading sb_gate_confirm(const struct sb_gate_rule *rule,
                                       const double *base, const double *head,
                                       const int *process, int n, bool over,
                                       double *scratch)
{
    const int pairs = n < rule->confirm_pairs ? n : rule->confirm_pairs;
    struct sb_gate_reading reading = nothing_read(pairs);
    reading.alpha = reading.alpha_within = rule->alpha;
    if (pairs > 0 && !read_pairs(rule, base, head, process, pairs, scratch, &reading))
        reading.verdict = SB_GATE_INVALID;
    else if (pairs < rule->confirm_pairs)
        reading.verdict = over ? SB_GATE_INCONCLUSIVE : SB_GATE_OPEN;
    else
        reading.verdict =
            reading.p_slower < reading.alpha ? SB_GATE_REGRESSION : SB_GATE_NOT_CONFIRMED;
    return reading;
}

int sb_gate_pairs_to_pass(const struct sb_gate_rule *rule, double spread)
{
    return sb_pairs_to_detect(spread, log1p(rule->tolerance),
                              rule->alpha / sb_look_count(&rule->looks), power);
}

// --- base against itself ------------------------------------------------------------------

struct sb_gate_bias sb_gate_bias(const struct sb_interval *ratio, int variants,
                                 double tolerance)
{
    struct sb_gate_bias worst = {-1, {NAN, NAN, NAN, 0}, NAN, NAN, false};
    for (int v = 0; v < variants; v++) {
        const double bias = fabs(ratio[v].point - 1);
        if (bias > worst.bias || (!isnan(bias) && worst.variant < 0)) {
            worst.variant = v;
            worst.ratio = ratio[v];
            worst.bias = bias;
        }
    }
    if (worst.variant < 0)
        return worst;
    // From 1 to the nearer bound, if the interval leaves 1 out; without bounds nothing is proven.
    worst.proven = fmax(0, fmax(worst.ratio.lo - 1, 1 - worst.ratio.hi));
    worst.tolerable = tolerance >= 2 * worst.bias;
    return worst;
}
