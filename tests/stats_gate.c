// The gate on scripted pairs, and on many families of simulated variants.
#include "test.h"

#include <limits.h>

#include "noise.h"
#include "stats/gate.h"
#include "stats/paired.h"
#include "stats/signed_rank.h"

enum { MOST = 400 };
static double base[MOST], head[MOST], scratch[4 * MOST], d[MOST];

// Times that drift and differ by `factor` give or take 1 %. The seed is one of those whose
// differences do not look dependent at 15 and 30 pairs, as about half do.
static void script(double factor, int n)
{
    struct sb_random random = sb_random_seed(2);
    for (int i = 0; i < n; i++) {
        base[i] = 1e6 * (1 + 0.2 * sin(i / 9.0));
        head[i] = base[i] * factor * (0.99 + 0.02 * sb_random_unit(&random));
    }
}

static struct sb_gate_reading read_scripted(double factor, int n, bool over)
{
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    script(factor, n);
    return sb_gate_read(&rule, base, head, NULL, n, over, scratch);
}

static void clear_cases_are_decided_at_the_first_look(void **state)
{
    (void)state;
    assert_int_equal(read_scripted(1.00, 15, false).verdict, SB_GATE_PASS);
    assert_int_equal(read_scripted(1.10, 15, false).verdict, SB_GATE_CANDIDATE);
    assert_int_equal(read_scripted(0.90, 15, false).verdict, SB_GATE_IMPROVED);
    // Faster, though not by more than the tolerance.
    assert_int_equal(read_scripted(0.985, 15, false).verdict, SB_GATE_PASS);
}

static void between_looks_nothing_is_decided_and_at_the_end_everything(void **state)
{
    (void)state;
    for (int n = 0; n <= 240; n++) {
        const bool look = n == 15 || n == 30 || n == 60 || n == 120 || n == 240;
        const struct sb_gate_reading slow = read_scripted(1.5, n, false);
        assert_int_equal(slow.verdict, look ? SB_GATE_CANDIDATE : SB_GATE_OPEN);
        // What is at the tolerance stays open to the last look.
        const struct sb_gate_reading tie = read_scripted(1.02, n, false);
        assert_int_equal(tie.verdict, n < 240 ? SB_GATE_OPEN : SB_GATE_INCONCLUSIVE);
        const struct sb_gate_reading over = read_scripted(1.02, n, true);
        assert_int_equal(over.verdict, SB_GATE_INCONCLUSIVE);
    }
    assert_int_equal(read_scripted(1.5, 37, true).verdict, SB_GATE_CANDIDATE);
    assert_int_equal(read_scripted(1.0, 37, true).verdict, SB_GATE_PASS);
    assert_int_equal(read_scripted(1.5, 3, true).verdict, SB_GATE_INCONCLUSIVE);
}

static void pairs_beyond_the_last_look_are_not_read(void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    script(1.02, 400);
    for (int i = 240; i < 400; i++)
        head[i] = 9 * base[i];
    const struct sb_gate_reading more =
        sb_gate_read(&rule, base, head, NULL, 400, 0, scratch);
    const struct sb_gate_reading just =
        sb_gate_read(&rule, base, head, NULL, 240, 0, scratch);
    assert_int_equal(more.n, 240);
    assert_int_equal(more.verdict, just.verdict);
    check_close(more.p_slower, just.p_slower, 0);
}

static void looks_share_the_alpha_of_the_family(void **state)
{
    (void)state;
    static const struct {
        int n, looks;
        bool over;
    } at[] = {{0, 0, 0},   {14, 0, 0},  {14, 1, 1},  {15, 1, 0},  {15, 1, 1},
              {16, 1, 0},  {16, 2, 1},  {30, 2, 0},  {60, 3, 0},  {100, 3, 0},
              {100, 4, 1}, {120, 4, 0}, {240, 5, 0}, {240, 5, 1}, {0, 0, 1}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        const struct sb_gate_reading reading = read_scripted(1.02, at[i].n, at[i].over);
        assert_int_equal(reading.looks, at[i].looks);
        check_close(reading.alpha, .0005, 1e-18);
        check_close(reading.alpha_within, .01, 1e-17);
        check_close(reading.alpha_spent, at[i].looks * .0005, 1e-17);
    }
}

static double phi(double z)
{
    return 0.5 * erfc(-z / sqrt(2));
}

// Shifts of d are factors of the times: the same p come from head made that much faster.
static void p_values_are_those_of_the_shifted_pairs(void **state)
{
    (void)state;
    struct sb_gate_rule rule = sb_gate_rule_default(7);
    struct sb_gate_reading reading = {.verdict = SB_GATE_OPEN};
    rule.tolerance = 0.05;
    static const double factors[] = {.949, 1.051, 1.049};
    for (int f = 0; f < 3; f++) {
        script(factors[f], 60);
        reading = sb_gate_read(&rule, base, head, NULL, 60, 0, scratch);
        assert_false(reading.blocked);
        for (int i = 0; i < 60; i++)
            d[i] = log(head[i] / 1.05 / base[i]);
        const double slower = sb_signed_rank_p(d, 60, 0, SB_GREATER, scratch);
        const double within = sb_signed_rank_p(d, 60, 0, SB_LESS, scratch);
        for (int i = 0; i < 60; i++)
            d[i] = log(head[i] / 0.95 / base[i]);
        const double faster = sb_signed_rank_p(d, 60, 0, SB_LESS, scratch);
        check_close(reading.p_slower, slower, 1e-12);
        check_close(reading.p_within, within, 1e-12);
        check_close(reading.p_faster, faster, 1e-12);
        // Of each two one is no foregone conclusion.
        assert_true(f == 0 ? faster > 1e-6 && faster < .3
                           : slower > 1e-6 && within > 1e-6);
    }
    const struct sb_interval ratio = sb_paired_ratio(base, head, 60, .95, scratch);
    check_close(reading.ratio.point, ratio.point, 0);
    check_close(reading.ratio.lo, ratio.lo, 0);
    check_close(reading.ratio.hi, ratio.hi, 0);
    // 7 variants, 5 looks: z[1 - 0.05/35] = 2.98270. 120 pairs confirm it nearly always.
    const double effect = (reading.mde - .05) / (1.02 * reading.spread);
    check_close(phi(effect * sqrt(60) - 2.98270) * phi(effect * sqrt(120) - 1.64485), .9,
                1e-5);
    check_close(effect * sqrt(60), 2.98270 + 1.28155, 1e-4);
    // Of one variant and as many pairs as confirm it, the confirmation misses some, too.
    const struct sb_gate_rule one = sb_gate_rule_default(1);
    script(1, 240);
    reading = sb_gate_read(&one, base, head, NULL, 240, 0, scratch);
    const double beyond = (reading.mde - .02) / (1.02 * reading.spread);
    check_close(phi(beyond * sqrt(240) - 2.32635) * phi(beyond * sqrt(120) - 1.64485), .9,
                1e-5);
    assert_true(beyond * sqrt(240) > 2.32635 + 1.28155 + .1);
    check_close(reading.spread, .01 / 2 * 1.4826, 2e-3); // uniform, give or take 1 %
}

static void equal_times_are_ties_and_pass(void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    for (int i = 0; i < 15; i++)
        base[i] = head[i] = 1000 + i;
    const struct sb_gate_reading same =
        sb_gate_read(&rule, base, head, NULL, 15, 0, scratch);
    assert_int_equal(same.verdict, SB_GATE_PASS);
    assert_int_equal(same.ties, 15);
    assert_true(isnan(same.autocorrelation));
    check_close(same.p_within, ldexp(1, -15), 1e-18);
    check_close(same.ratio.point, 1, 0);
    // At tolerance 0 equal times are neither slower nor within: half of each.
    struct sb_gate_rule strict = rule;
    strict.tolerance = 0;
    const struct sb_gate_reading zero =
        sb_gate_read(&strict, base, head, NULL, 15, 1, scratch);
    assert_int_equal(zero.verdict, SB_GATE_INCONCLUSIVE);
    check_close(zero.p_slower, 1, 0);
    check_close(zero.p_within, 1, 0);
}

static void dependent_pairs_are_ranked_in_blocks_of_five(void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    static const int sizes[] = {60, 63, 64};
    for (int s = 0; s < 3; s++) {
        const int n = sizes[s];
        for (int i = 0; i < n; i++) {
            base[i] = 1e6;
            head[i] = base[i] * (1.02 + 0.01 * sin(i / 3.0) + 1e-4 * i);
        }
        const struct sb_gate_reading reading =
            sb_gate_read(&rule, base, head, NULL, n, true, scratch);
        assert_true(reading.autocorrelation > 0.8);
        assert_true(reading.blocked);
        assert_int_equal(reading.n, n);
        assert_int_equal(reading.ratio.n, 12);
        double sum[12] = {0};
        int count[12] = {0};
        for (int i = 0; i < n; i++) {
            const int block = i / 5 < 11 ? i / 5 : 11;
            sum[block] += log(head[i] / base[i]);
            count[block]++;
        }
        for (int b = 0; b < 12; b++)
            d[b] = sum[b] / count[b];
        check_close(reading.p_slower,
                    sb_signed_rank_p(d, 12, log(1.02), SB_GREATER, scratch), 1e-15);
        for (int b = 0; b < 12; b++) {
            base[b] = 1;
            head[b] = exp(d[b]);
        }
        const struct sb_interval ratio = sb_paired_ratio(base, head, 12, .95, scratch);
        check_close(reading.ratio.point, ratio.point, 1e-14);
        check_close(reading.ratio.lo, ratio.lo, 1e-14);
    }
    for (int n = 1; n < 5; n++) {
        const struct sb_gate_reading few =
            sb_gate_read(&rule, base, head, NULL, n, 1, scratch);
        assert_int_equal(few.verdict, SB_GATE_INCONCLUSIVE);
    }
}

// The second batch of each pair is the cheaper, whatever its side: no reason for blocks, and none
// against them.
static void turns_of_order_neither_make_pairs_dependent_nor_hide_that_they_are(
    void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    struct sb_random random = sb_random_seed(11);
    for (int dependent = 0; dependent < 2; dependent++) {
        double noise = 0;
        for (int i = 0; i < 240; i++) {
            const double memory = dependent ? 0.6 : 0;
            noise = memory * noise + sqrt(1 - memory * memory) * normal_noise(&random);
            base[i] = 1e6;
            head[i] = base[i] * (i % 2 ? 1.03 : 0.97) * exp(0.02 * noise);
        }
        const struct sb_gate_reading reading =
            sb_gate_read(&rule, base, head, NULL, 240, 0, scratch);
        check_close(reading.autocorrelation, dependent ? 0.6 : 0, 0.15);
        assert_int_equal(reading.blocked, dependent);
        assert_int_equal(reading.ratio.n, dependent ? 48 : 240);
    }
}

// Two processes have levels of their own: 16 of them are 16 values, however many pairs each has.
static void pairs_of_processes_are_ranked_as_their_averages(void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(1);
    struct sb_random random = sb_random_seed(4);
    int process[240], n = 0;
    for (int p = 0; p < 16; p++) {
        const double level = exp(0.05 * normal_noise(&random));
        for (int i = 0; i < 5 - p % 2; i++, n++) {
            process[n] = 3 * p;
            base[n] = 1e6;
            head[n] = base[n] * 1.1 * level * exp(0.001 * normal_noise(&random));
        }
    }
    const struct sb_gate_reading reading =
        sb_gate_read(&rule, base, head, process, n, true, scratch);
    assert_true(reading.blocked);
    assert_int_equal(reading.ratio.n, 16);
    for (int p = 0, at = 0; p < 16; p++) {
        d[p] = 0;
        for (int i = 0; i < 5 - p % 2; i++, at++)
            d[p] += log(head[at] / base[at]) / (5 - p % 2);
    }
    check_close(reading.p_slower, sb_signed_rank_p(d, 16, log(1.02), SB_GREATER, scratch),
                1e-15);
    // Two or three processes decide nothing.
    for (int few = 1; few <= 15; few++)
        assert_int_equal(
            sb_gate_read(&rule, base, head, process, few, true, scratch).verdict,
            SB_GATE_INCONCLUSIVE);
}

static void a_confirmation_judges_just_the_pairs_planned(void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    script(1.03, 400);
    for (int i = 120; i < 400; i++)
        head[i] = base[i] / 2;
    for (int n = 119; n <= 400; n += 281) {
        const struct sb_gate_reading r =
            sb_gate_confirm(&rule, base, head, NULL, n, 0, scratch);
        assert_int_equal(r.verdict, n < 120 ? SB_GATE_OPEN : SB_GATE_REGRESSION);
        assert_int_equal(r.n, n < 120 ? n : 120);
        check_close(r.alpha, .05, 0);
    }
    assert_int_equal(sb_gate_confirm(&rule, base, head, NULL, 119, 1, scratch).verdict,
                     SB_GATE_INCONCLUSIVE);
    assert_int_equal(sb_gate_confirm(&rule, base, head, NULL, 0, 1, scratch).verdict,
                     SB_GATE_INCONCLUSIVE);
    script(1.02, 120);
    assert_int_equal(sb_gate_confirm(&rule, base, head, NULL, 120, 0, scratch).verdict,
                     SB_GATE_NOT_CONFIRMED);
    script(0.5, 120); // much faster, and yet no more than cleared
    assert_int_equal(sb_gate_confirm(&rule, base, head, NULL, 120, 0, scratch).verdict,
                     SB_GATE_NOT_CONFIRMED);
}

static void times_that_are_none_make_it_invalid(void **state)
{
    (void)state;
    const struct sb_gate_rule rule = sb_gate_rule_default(20);
    static const double none[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 8; i++) {
        script(1, 120);
        (i % 2 ? base : head)[14] = none[i / 2];
        const struct sb_gate_reading r =
            sb_gate_read(&rule, base, head, NULL, 15, 0, scratch);
        assert_int_equal(r.verdict, SB_GATE_INVALID);
        assert_int_equal(sb_gate_read(&rule, base, head, NULL, 14, 0, scratch).verdict,
                         SB_GATE_OPEN);
        assert_int_equal(
            sb_gate_confirm(&rule, base, head, NULL, 120, 0, scratch).verdict,
            SB_GATE_INVALID);
    }
}

static void every_verdict_has_a_word_of_its_own(void **state)
{
    (void)state;
    for (int v = 0; v < SB_GATE_VERDICT_COUNT; v++) {
        assert_int_equal(sb_gate_verdict_find(sb_gate_verdict_rows[v].word), v);
        assert_true(strlen(sb_gate_verdict_rows[v].help) > 10);
    }
    assert_int_equal(sb_gate_verdict_find("fail"), SB_GATE_VERDICT_COUNT);
}

// (2.32635 + 1.28155)^2 (1.02 s / ln 1.02)^2, with z of 99 % and 90 %.
static void pairs_to_pass_are_those_computed_by_hand(void **state)
{
    (void)state;
    struct sb_gate_rule rule = sb_gate_rule_default(20);
    assert_int_equal(sb_gate_pairs_to_pass(&rule, .04),
                     ceil(pow(3.60790 * 1.02 * .04 / log(1.02), 2)));
    rule.tolerance = 0;
    assert_int_equal(sb_gate_pairs_to_pass(&rule, .04), INT_MAX);
}

// --- base against itself ------------------------------------------------------------------

static void the_largest_bias_is_told_with_what_of_it_is_proven(void **state)
{
    (void)state;
    const struct sb_interval ratio[] = {{1.002, 0.999, 1.005, 60},
                                        {NAN, NAN, NAN, 0},
                                        {0.992, 0.990, 0.994, 60},
                                        {1.007, 0.990, 1.024, 60}};
    const struct sb_gate_bias bias = sb_gate_bias(ratio, 4, .02);
    assert_int_equal(bias.variant, 2);
    check_close(bias.bias, .008, 1e-15);
    check_close(bias.proven, .006, 1e-15);
    check_close(bias.ratio.lo, .990, 0);
    assert_true(bias.tolerable);
    assert_false(sb_gate_bias(ratio, 4, .0159).tolerable);
    check_close(sb_gate_bias(ratio, 1, .02).proven, 0, 0);
    const struct sb_interval slow = {1.01, 1.004, 1.016, 60}, few = {1.01, NAN, NAN, 3};
    check_close(sb_gate_bias(&slow, 1, .02).proven, .004, 1e-15);
    assert_false(sb_gate_bias(&slow, 1, .0199).tolerable);
    check_close(sb_gate_bias(&few, 1, .02).proven, 0, 0);
    assert_int_equal(sb_gate_bias(ratio + 1, 1, .02).variant, -1);
    assert_false(sb_gate_bias(ratio + 1, 1, .02).tolerable);
}

// --- families -----------------------------------------------------------------------------

enum { VARIANTS = 20 };

struct tally {
    int candidates, regressions, passes; // variants
    int alarmed, confirmed;              // families with a candidate, with a regression
    double pairs;                        // mean over variants
};

static void measure(struct sb_random *random, double effect, double memory, int n)
{
    double noise = normal_noise(random);
    for (int i = 0; i < n; i++) {
        noise = memory * noise + sqrt(1 - memory * memory) * normal_noise(random);
        base[i] = 1e6 * (1 + 0.2 * sin(i / 30.0));
        head[i] = base[i] * (1 + effect) * exp(0.04 * noise);
    }
}

// Variants that are all slower by `effect`, with 4 % of noise, through the whole gate.
static struct tally simulate(double effect, double memory, int families, uint64_t seed)
{
    const struct sb_gate_rule rule = sb_gate_rule_default(VARIANTS);
    struct sb_random random = sb_random_seed(seed);
    struct tally tally = {0};
    for (int variant = 0, alarmed = 0, confirmed = 0; variant < families * VARIANTS;) {
        struct sb_gate_reading reading = {.verdict = SB_GATE_OPEN};
        measure(&random, effect, memory, 240);
        for (int n = 1; reading.verdict == SB_GATE_OPEN; n++)
            if (sb_look_due(&rule.looks, n))
                reading = sb_gate_read(&rule, base, head, NULL, n, false, scratch);
        tally.pairs += (double)reading.n / VARIANTS / families;
        tally.passes += reading.verdict == SB_GATE_PASS;
        if (reading.verdict == SB_GATE_CANDIDATE) {
            tally.candidates++;
            alarmed = 1;
            measure(&random, effect, memory, 120);
            reading = sb_gate_confirm(&rule, base, head, NULL, 120, false, scratch);
            tally.regressions += reading.verdict == SB_GATE_REGRESSION;
            confirmed |= reading.verdict == SB_GATE_REGRESSION;
        }
        if (++variant % VARIANTS == 0) {
            tally.alarmed += alarmed;
            tally.confirmed += confirmed;
            alarmed = confirmed = 0;
        }
    }
    return tally;
}

static void unchanged_families_pass_without_an_alarm_and_soon(void **state)
{
    (void)state;
    const struct tally tally = simulate(0, 0, 200, 3);
    assert_int_equal(tally.alarmed, 0);
    assert_true(tally.passes >= 0.98 * 200 * VARIANTS);
    assert_in_range((int)tally.pairs, 30, 60);
}

// All of them as slow as is allowed: the worst that must not alarm. 5 % of 200 is 10, of which
// chance alone makes 18 in one case of 100.
static void families_at_the_tolerance_alarm_no_more_than_alpha(void **state)
{
    (void)state;
    const struct tally tally = simulate(.02, 0, 200, 5);
    assert_in_range(tally.alarmed, 0, 18);
    assert_in_range(tally.confirmed, 0, 3);
    assert_true(tally.passes <= 0.06 * 200 * VARIANTS); // wrongly, at most 1 % a look
}

static void families_with_memory_do_not_alarm_once_confirmed(void **state)
{
    (void)state;
    const struct tally tally = simulate(.02, .3, 100, 7);
    assert_in_range(tally.confirmed, 0, 5);
    assert_int_equal(simulate(0, .3, 50, 7).alarmed, 0);
}

static void slowdowns_beyond_the_tolerance_are_found(void **state)
{
    (void)state;
    const struct tally three = simulate(.03, 0, 50, 11), five = simulate(.05, 0, 50, 13);
    assert_in_range(three.regressions, 0.45 * 50 * VARIANTS, 0.85 * 50 * VARIANTS);
    assert_in_range(five.regressions, 0.99 * 50 * VARIANTS, 50 * VARIANTS);
    assert_int_equal(five.passes, 0);
    assert_true(five.pairs < 80);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clear_cases_are_decided_at_the_first_look),
        cmocka_unit_test(between_looks_nothing_is_decided_and_at_the_end_everything),
        cmocka_unit_test(pairs_beyond_the_last_look_are_not_read),
        cmocka_unit_test(looks_share_the_alpha_of_the_family),
        cmocka_unit_test(p_values_are_those_of_the_shifted_pairs),
        cmocka_unit_test(equal_times_are_ties_and_pass),
        cmocka_unit_test(dependent_pairs_are_ranked_in_blocks_of_five),
        cmocka_unit_test(
            turns_of_order_neither_make_pairs_dependent_nor_hide_that_they_are),
        cmocka_unit_test(pairs_of_processes_are_ranked_as_their_averages),
        cmocka_unit_test(a_confirmation_judges_just_the_pairs_planned),
        cmocka_unit_test(times_that_are_none_make_it_invalid),
        cmocka_unit_test(every_verdict_has_a_word_of_its_own),
        cmocka_unit_test(pairs_to_pass_are_those_computed_by_hand),
        cmocka_unit_test(the_largest_bias_is_told_with_what_of_it_is_proven),
        cmocka_unit_test(unchanged_families_pass_without_an_alarm_and_soon),
        cmocka_unit_test(families_at_the_tolerance_alarm_no_more_than_alpha),
        cmocka_unit_test(families_with_memory_do_not_alarm_once_confirmed),
        cmocka_unit_test(slowdowns_beyond_the_tolerance_are_found),
    };
    return run_tests(tests);
}
