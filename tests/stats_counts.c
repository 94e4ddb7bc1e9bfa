// The judgement on counts that repeat.
#include "test.h"

#include "math/random.h"
#include "stats/counts.h"

static const double tolerance = 0.005;
static const double million[5] = {1e6, 1e6, 1e6, 1e6, 1e6};

static struct sb_counts_reading read_some(const double *base, const double *head, int n)
{
    double scratch[SB_COUNTS_MOST];
    return sb_counts_read(tolerance, base, head, n, false, scratch);
}

// Three counts a side, the largest of them `spread` above the others.
static enum sb_gate_verdict verdict_of(double ratio, double spread)
{
    const double base[3] = {1e7, 1e7 * (1 + spread), 1e7};
    const double head[3] = {1e7 * ratio * (1 + spread), 1e7 * ratio, 1e7 * ratio};
    return read_some(base, head, 3).verdict;
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
        assert_int_equal(verdict_of(ratios[i], 0.0013), SB_GATE_OPEN);
        assert_int_not_equal(verdict_of(ratios[i], 0.0012), SB_GATE_OPEN);
    }
    const double scattered[5] = {1e6, 1.01e6, 1.02e6, 1.03e6, 1.04e6};
    for (int n = 1; n <= SB_COUNTS_MOST; n++) {
        double scratch[SB_COUNTS_MOST];
        assert_int_equal(read_some(scattered, million, n).verdict,
                         n < SB_COUNTS_MOST ? SB_GATE_OPEN : SB_GATE_INCONCLUSIVE);
        assert_int_equal(
            sb_counts_read(tolerance, million, scattered, n, true, scratch).verdict,
            SB_GATE_INCONCLUSIVE);
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
    const double base[3] = {10000, 10004, 10001}, head[3] = {20002, 20006, 20000};
    const struct sb_counts_reading reading = read_some(base, head, 3);
    check_close(reading.ratio.point, 20002.0 / 10001, 1e-12);
    check_close(reading.ratio.lo, 20000.0 / 10004, 1e-12);
    check_close(reading.ratio.hi, 20006.0 / 10000, 1e-12);
    check_close(reading.repeatability, 4.0 / 10001, 1e-12);
    check_close(reading.base, 10001, 0);
    check_close(reading.head, 20002, 0);
    assert_int_equal(reading.ratio.n, 3);
    assert_int_equal(reading.apart, 0);
    // Which repeat came first does not matter, and neither side is written to.
    const double turned[3] = {10001, 10000, 10004};
    const struct sb_counts_reading again = read_some(turned, head, 3);
    check_close(again.ratio.lo, reading.ratio.lo, 0);
    check_close(again.ratio.hi, reading.ratio.hi, 0);
    check_close(base[1], 10004, 0);
}

static void a_count_that_stands_apart_is_outvoted_and_told_of(void **state)
{
    (void)state;
    static const double off[] = {0.33, 0.002, -0.01};
    for (size_t k = 0; k < sizeof off / sizeof *off; k++)
        for (int place = 0; place < 3; place++) {
            double base[5];
            memcpy(base, million, sizeof base);
            base[place] = 1e6 * (1 + off[k]);
            // Two of three agree: no majority of the three that are wanted.
            assert_int_equal(read_some(base, million, 3).verdict, SB_GATE_OPEN);
            const struct sb_counts_reading reading = read_some(base, million, 4);
            assert_int_equal(reading.verdict, SB_GATE_PASS);
            check_close(reading.ratio.point, 1, 0);
            check_close(reading.repeatability, 0, 0);
            assert_int_equal(reading.apart, 1);
            check_close(reading.farthest, off[k], 1e-9);
        }
}

static void two_kinds_of_frame_are_no_majority(void **state)
{
    (void)state;
    const double half[4] = {1e6, 1.01e6, 1e6, 1.01e6};
    assert_int_equal(read_some(half, million, 4).verdict, SB_GATE_OPEN);
    const double five[5] = {1e6, 1.01e6, 1e6, 1.01e6, 1.02e6};
    assert_int_equal(read_some(five, million, 5).verdict, SB_GATE_INCONCLUSIVE);
    assert_int_equal(read_some(million, five, 5).verdict, SB_GATE_INCONCLUSIVE);
}

static void what_is_no_count_is_invalid(void **state)
{
    (void)state;
    static const double wrong[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < 4; i++) {
        const double bad[3] = {1e6, wrong[i], 1e6};
        assert_int_equal(read_some(million, bad, 3).verdict, SB_GATE_INVALID);
        assert_int_equal(read_some(bad, million, 3).verdict, SB_GATE_INVALID);
    }
}

static void no_count_tells_nothing(void **state)
{
    (void)state;
    const struct sb_counts_reading none =
        sb_counts_read(tolerance, NULL, NULL, 0, true, NULL);
    assert_int_equal(none.verdict, SB_GATE_INCONCLUSIVE);
    assert_true(isnan(none.ratio.point));
    assert_true(isnan(none.repeatability));
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

// One count of a hundred has half as much again, as a driver's new buffers do; the others differ
// by a millionth. Of gates that take counts until the verdict is not open, so many are wrong.
static int wrong_of(int gates, double ratio, enum sb_gate_verdict right)
{
    struct sb_random random = sb_random_seed(5);
    int wrong = 0;
    for (int gate = 0; gate < gates; gate++) {
        double base[SB_COUNTS_MOST], head[SB_COUNTS_MOST];
        enum sb_gate_verdict verdict = SB_GATE_OPEN;
        for (int n = 0; verdict == SB_GATE_OPEN;) {
            double *const sides[] = {base, head};
            for (int side = 0; side < 2; side++)
                sides[side][n] = 1e6 * (1 + 1e-6 * sb_random_unit(&random)) *
                                 (side ? ratio : 1) *
                                 (sb_random_below(&random, 100) == 0 ? 1.5 : 1);
            verdict = read_some(base, head, ++n).verdict;
        }
        wrong += verdict != right;
    }
    return wrong;
}

static void rare_work_of_a_driver_changes_no_verdict(void **state)
{
    (void)state;
    // Three of five apart have a probability of some 1e-5 a side, and are inconclusive or alarm.
    assert_true(wrong_of(20000, 1, SB_GATE_PASS) <= 3);
    assert_true(wrong_of(20000, 1.01, SB_GATE_CANDIDATE) <= 3);
    assert_true(wrong_of(20000, 0.99, SB_GATE_IMPROVED) <= 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_that_repeat_are_told_apart_at_the_tolerance),
        cmocka_unit_test(counts_that_do_not_repeat_claim_nothing),
        cmocka_unit_test(a_tolerance_within_the_range_is_inconclusive),
        cmocka_unit_test(ratio_and_repeatability_are_those_of_the_counts),
        cmocka_unit_test(a_count_that_stands_apart_is_outvoted_and_told_of),
        cmocka_unit_test(two_kinds_of_frame_are_no_majority),
        cmocka_unit_test(what_is_no_count_is_invalid),
        cmocka_unit_test(no_count_tells_nothing),
        cmocka_unit_test(only_a_candidate_that_is_one_again_is_a_regression),
        cmocka_unit_test(rare_work_of_a_driver_changes_no_verdict),
    };
    return run_tests(tests);
}
