// The judgement on counts that repeat.
#include "test.h"

#include "math/random.h"
#include "stats/counts.h"

static const double tolerance = 0.005;

static struct sb_counts_reading read_three(const double base[3], const double head[3])
{
    double scratch[3];
    return sb_counts_read(tolerance, base, head, 3, scratch);
}

static enum sb_gate_verdict verdict_of(double ratio, double spread)
{
    const double base[3] = {1e7, 1e7 * (1 + spread), 1e7};
    const double head[3] = {1e7 * ratio * (1 + spread), 1e7 * ratio, 1e7 * ratio};
    return read_three(base, head).verdict;
}

static void counts_that_repeat_are_told_apart_at_the_tolerance(void **state)
{
    (void)state;
    static const struct {
        double ratio;
        enum sb_gate_verdict verdict;
    } rows[] = {
        {1, SB_GATE_PASS},          {1.0049, SB_GATE_PASS},  {1.0051, SB_GATE_CANDIDATE},
        {1.01, SB_GATE_CANDIDATE},  {2, SB_GATE_CANDIDATE},  {0.9951, SB_GATE_PASS},
        {0.9949, SB_GATE_IMPROVED}, {0.5, SB_GATE_IMPROVED},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_int_equal(verdict_of(rows[i].ratio, 0), rows[i].verdict);
}

static void counts_that_do_not_repeat_claim_nothing(void **state)
{
    (void)state;
    static const double ratios[] = {0.9, 1, 1.01, 1.5};
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(verdict_of(ratios[i], 0.0013), SB_GATE_INCONCLUSIVE);
        assert_int_not_equal(verdict_of(ratios[i], 0.0012), SB_GATE_INCONCLUSIVE);
    }
}

static void a_tolerance_within_the_range_is_inconclusive(void **state)
{
    (void)state;
    // 0.05 % of spread on both sides of 0.5 %.
    assert_int_equal(verdict_of(1.0048, 0.0005), SB_GATE_INCONCLUSIVE);
    assert_int_equal(verdict_of(1.0052, 0.0005), SB_GATE_INCONCLUSIVE);
    assert_int_equal(verdict_of(1.0044, 0.0005), SB_GATE_PASS);
    assert_int_equal(verdict_of(1.0056, 0.0005), SB_GATE_CANDIDATE);
    // Nor is it an improvement where one repeat is none.
    assert_int_equal(verdict_of(0.9948, 0.0005), SB_GATE_PASS);
}

static void ratio_and_repeatability_are_those_of_the_counts(void **state)
{
    (void)state;
    const double base[3] = {1000, 1004, 1001}, head[3] = {2002, 2006, 2000};
    const struct sb_counts_reading reading = read_three(base, head);
    check_close(reading.ratio.point, 2002.0 / 1001, 1e-12);
    check_close(reading.ratio.lo, 2000.0 / 1004, 1e-12);
    check_close(reading.ratio.hi, 2006.0 / 1000, 1e-12);
    check_close(reading.repeatability, 4.0 / 1001, 1e-12);
    assert_int_equal(reading.ratio.n, 3);
    // Which repeat came first does not matter, and neither side is written to.
    const double turned[3] = {1001, 1000, 1004};
    const struct sb_counts_reading again = read_three(turned, head);
    check_close(again.ratio.lo, reading.ratio.lo, 0);
    check_close(again.ratio.hi, reading.ratio.hi, 0);
    check_close(again.repeatability, reading.repeatability, 0);
    check_close(base[1], 1004, 0);
}

static void what_is_no_count_is_invalid(void **state)
{
    (void)state;
    static const double wrong[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < 4; i++) {
        const double good[3] = {1e6, 1e6, 1e6}, bad[3] = {1e6, wrong[i], 1e6};
        assert_int_equal(read_three(good, bad).verdict, SB_GATE_INVALID);
        assert_int_equal(read_three(bad, good).verdict, SB_GATE_INVALID);
    }
}

static void one_repeat_tells_no_repeatability(void **state)
{
    (void)state;
    const double base = 1e6, head = 2e6;
    double scratch;
    const struct sb_counts_reading one =
        sb_counts_read(tolerance, &base, &head, 1, &scratch);
    assert_int_equal(one.verdict, SB_GATE_INCONCLUSIVE);
    check_close(one.ratio.point, 2, 0);
    const struct sb_counts_reading none = sb_counts_read(tolerance, NULL, NULL, 0, NULL);
    assert_int_equal(none.verdict, SB_GATE_INCONCLUSIVE);
    assert_true(isnan(none.ratio.point));
}

static void only_a_candidate_that_is_one_again_is_a_regression(void **state)
{
    (void)state;
    for (int verdict = 0; verdict < SB_GATE_VERDICT_COUNT; verdict++) {
        const struct sb_counts_reading fresh = {.verdict = (enum sb_gate_verdict)verdict};
        const enum sb_gate_verdict confirmed = sb_counts_confirm(&fresh);
        assert_int_equal(confirmed == SB_GATE_REGRESSION, verdict == SB_GATE_CANDIDATE);
        if (verdict == SB_GATE_PASS || verdict == SB_GATE_IMPROVED)
            assert_int_equal(confirmed, SB_GATE_NOT_CONFIRMED);
        else if (verdict != SB_GATE_CANDIDATE)
            assert_int_equal(confirmed, SB_GATE_INCONCLUSIVE);
    }
}

// Whatever the noise: equal sides are never a candidate, and twice the tolerance passes never.
static void noise_costs_verdicts_and_makes_none(void **state)
{
    (void)state;
    struct sb_random random = sb_random_seed(5);
    for (int trial = 0; trial < 20000; trial++) {
        const double noise = 0.01 * sb_random_unit(&random);
        double base[3], equal[3], more[3];
        for (int i = 0; i < 3; i++) {
            base[i] = 1e7 * (1 + noise * sb_random_unit(&random));
            equal[i] = 1e7 * (1 + noise * sb_random_unit(&random));
            more[i] = 1.02 * 1e7 * (1 + noise * sb_random_unit(&random));
        }
        assert_int_not_equal(read_three(base, more).verdict, SB_GATE_PASS);
        if (noise < 0.005)
            assert_int_not_equal(read_three(base, equal).verdict, SB_GATE_CANDIDATE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_that_repeat_are_told_apart_at_the_tolerance),
        cmocka_unit_test(counts_that_do_not_repeat_claim_nothing),
        cmocka_unit_test(a_tolerance_within_the_range_is_inconclusive),
        cmocka_unit_test(ratio_and_repeatability_are_those_of_the_counts),
        cmocka_unit_test(what_is_no_count_is_invalid),
        cmocka_unit_test(one_repeat_tells_no_repeatability),
        cmocka_unit_test(only_a_candidate_that_is_one_again_is_a_regression),
        cmocka_unit_test(noise_costs_verdicts_and_makes_none),
    };
    return run_tests(tests);
}
