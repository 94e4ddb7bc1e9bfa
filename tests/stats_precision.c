#include "test.h"

#include "stats/audit.h"

static const struct sb_precision_reading full = {
    .precision = 1,
    .add = 2050,
    .square = 256,
    .tiny = 1,
    .round = 0x1.8p-11f,
};
static const struct sb_precision_reading half = {
    // llvmpipe under GLES
    .precision = 1, .add = 2048, .square = INFINITY, .tiny = 1, .round = 0x1p-10f,
};

static struct sb_precision_verdict judge(struct sb_precision_reading reading)
{
    struct sb_precision_verdict verdict;
    memset(&verdict, 0xff, sizeof verdict);
    sb_precision_judge(&reading, &verdict);
    return verdict;
}

static void full_floats_are_honoured_at_highp_and_ignore_mediump(void **state)
{
    (void)state;
    struct sb_precision_reading reading = full;
    struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP32);
    assert_string_equal(verdict.text, "ignored: fp32");
    reading.precision = 0;
    verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP32);
    assert_string_equal(verdict.text, "honoured as fp32");
}

static void half_floats_are_recognised_with_their_rules(void **state)
{
    (void)state;
    const struct sb_precision_verdict verdict = judge(half);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
    assert_true(verdict.overflow_inf && verdict.subnormals && verdict.round_nearest);
    assert_string_equal(verdict.text,
                        "honoured as fp16 (overflow to inf, subnormals kept, "
                        "round to nearest even)");
    struct sb_precision_reading wide = half;
    wide.precision = 0;
    check_contains(judge(wide).text, "not honoured: fp16");
}

static void flushed_subnormals_are_recognised(void **state)
{
    (void)state;
    struct sb_precision_reading reading = half;
    reading.tiny = 0;
    const struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
    assert_false(verdict.subnormals);
    assert_true(verdict.overflow_inf && verdict.round_nearest);
    check_contains(verdict.text, "subnormals flushed");
}

static void saturating_overflow_is_recognised(void **state)
{
    (void)state;
    struct sb_precision_reading reading = half;
    reading.square = 65504.0f / 256;
    const struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
    assert_false(verdict.overflow_inf);
    assert_true(verdict.subnormals && verdict.round_nearest);
    check_contains(verdict.text, "overflow saturates");
}

static void rounding_towards_zero_is_recognised(void **state)
{
    (void)state;
    struct sb_precision_reading reading = half;
    reading.round = 0;
    const struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
    assert_false(verdict.round_nearest);
    assert_true(verdict.overflow_inf && verdict.subnormals);
    check_contains(verdict.text, "round towards zero");
}

static void a_mixture_is_named_term_by_term(void **state)
{
    (void)state;
    struct sb_precision_reading reading = full;
    reading.add = 2048;
    struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_OTHER);
    assert_string_equal(verdict.text, "partly: addition fp16, multiplication fp32, "
                                      "rounding fp32, 2^-20 kept");
    reading = full;
    reading.tiny = 0; // fp32 would have kept it
    verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_OTHER);
    check_contains(verdict.text, "partly");
    reading = half;
    reading.square = 256;
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
    reading = half;
    reading.round = full.round;
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
}

static void numbers_of_neither_kind_are_not_taken_for_either(void **state)
{
    (void)state;
    // Ten-bit fixed point up to 2, and a probe that came back as NaN.
    const struct sb_precision_reading fixed = {
        .precision = 2, .add = 2, .square = 2, .tiny = 2, .round = 0x1p-8f};
    struct sb_precision_verdict verdict = judge(fixed);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_OTHER);
    check_contains(verdict.text, "neither fp32 nor fp16");
    assert_false(verdict.overflow_inf || verdict.subnormals || verdict.round_nearest);
    const struct sb_precision_reading lost = {
        .precision = 1, .add = NAN, .square = NAN, .tiny = NAN, .round = NAN};
    verdict = judge(lost);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_OTHER);
    struct sb_precision_reading odd = half;
    odd.tiny = 0.5f;
    assert_int_equal(judge(odd).effective, SB_EFFECTIVE_OTHER);
    odd = half;
    odd.square = -INFINITY;
    assert_int_equal(judge(odd).effective, SB_EFFECTIVE_OTHER);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_floats_are_honoured_at_highp_and_ignore_mediump),
        cmocka_unit_test(half_floats_are_recognised_with_their_rules),
        cmocka_unit_test(flushed_subnormals_are_recognised),
        cmocka_unit_test(saturating_overflow_is_recognised),
        cmocka_unit_test(rounding_towards_zero_is_recognised),
        cmocka_unit_test(a_mixture_is_named_term_by_term),
        cmocka_unit_test(numbers_of_neither_kind_are_not_taken_for_either),
    };
    return run_tests(tests);
}
