#include "test.h"

#include "stats/audit.h"

static const struct sb_precision_reading full = {
    .precision = 1,
    .add = 2050,
    .square = 256,
    .tiny = 1,
    .round = 0x1.8p-11f,
    .lone = 2049,
    .used = NAN,
};
static const struct sb_precision_reading half = {
    .precision = 1,
    .add = 2048,
    .square = INFINITY,
    .tiny = 1,
    .round = 0x1p-10f,
    .lone = 2048,
    .used = NAN,
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
                                      "rounding fp32, 2^-20 kept, alone fp32");
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
        .precision = 2, .add = 2, .square = 2, .tiny = 2, .round = 0x1p-8f, .used = NAN};
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

static void a_lone_operation_that_is_folded_is_said_to_be(void **state)
{
    (void)state;
    struct sb_precision_reading reading = half; // llvmpipe under GLES
    reading.lone = 2049;
    const struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
    assert_true(verdict.lone_folded);
    check_contains(verdict.text, "round to nearest even; a lone operation fp32)");
    assert_false(judge(half).lone_folded);
    // Chains at fp32 and one operation at fp16 is no format.
    reading = full;
    reading.lone = 2048;
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
    check_contains(judge(reading).text, "alone fp16");
    reading = half;
    reading.lone = 7;
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
}

// What a driver makes of a value that it carries, by the formats' own arithmetic.
struct format {
    bool half, saturates, flushes, cuts, rounds_in_use;
};

static float to_half(const struct format *format, float x)
{
    int exponent;
    if (!format->half)
        return x;
    if (x >= 65520)
        return format->saturates ? 65504 : INFINITY;
    frexpf(x, &exponent); // x is in [2^(exponent - 1), 2^exponent)
    const bool subnormal = exponent - 1 < -14;
    if (subnormal && format->flushes)
        return 0;
    const float ulp = ldexpf(1, subnormal ? -24 : exponent - 11);
    return (format->cuts ? truncf(x / ulp) : rintf(x / ulp)) * ulp;
}

static struct sb_precision_reading carry(enum sb_carrier carrier, int precision,
                                         const struct format *format)
{
    struct sb_precision_reading reading = {
        .carrier = carrier,
        .precision = precision,
        .add = 2 * to_half(format, 2049) - 2048,
        .square = to_half(format, 65536) / 256,
        .tiny = to_half(format, 0x1p-20f) * 0x1p20f,
        .round = to_half(format, 1 + 0x1.8p-11f) - 1,
        .lone = NAN,
        .used = format->half || format->rounds_in_use ? 0 : 1,
    };
    if (carrier == SB_CARRIER_OUTPUT) // nothing computes with it
        reading.used = NAN;
    return reading;
}

static void every_carrier_is_judged_by_the_rules_of_its_format(void **state)
{
    (void)state;
    for (int carrier = SB_CARRIER_UNIFORM; carrier < SB_CARRIER_COUNT; carrier++) {
        for (int rules = 0; rules < 8; rules++) {
            const struct format format = {.half = true,
                                          .saturates = rules & 1,
                                          .flushes = rules & 2,
                                          .cuts = rules & 4};
            const struct sb_precision_verdict verdict =
                judge(carry((enum sb_carrier)carrier, 1, &format));
            char text[160];
            assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
            assert_int_equal(verdict.overflow_inf, !format.saturates);
            assert_int_equal(verdict.subnormals, !format.flushes);
            assert_int_equal(verdict.round_nearest, !format.cuts);
            assert_false(verdict.lone_folded || verdict.rounded_in_use);
            snprintf(text, sizeof text,
                     "honoured as fp16 (overflow %s, subnormals %s, round %s)",
                     format.saturates ? "saturates" : "to inf",
                     format.flushes ? "flushed" : "kept",
                     format.cuts ? "towards zero" : "to nearest even");
            assert_string_equal(verdict.text, text);
        }
        const struct format wide = {.half = false};
        assert_string_equal(judge(carry((enum sb_carrier)carrier, 2, &wide)).text,
                            "ignored: fp32");
        assert_string_equal(judge(carry((enum sb_carrier)carrier, 0, &wide)).text,
                            "honoured as fp32");
    }
}

static void a_carrier_that_only_arithmetic_rounds_is_ignored_and_said_to_be(void **state)
{
    (void)state;
    const struct format format = {.rounds_in_use = true};
    const struct sb_precision_verdict verdict =
        judge(carry(SB_CARRIER_UNIFORM, 1, &format));
    assert_int_equal(verdict.effective, SB_EFFECTIVE_FP32);
    assert_true(verdict.rounded_in_use);
    assert_string_equal(verdict.text, "ignored: fp32, rounded once arithmetic takes it");
    // At highp nothing may round it, nor may arithmetic restore what a carrier lost.
    struct sb_precision_reading reading = carry(SB_CARRIER_UNIFORM, 0, &format);
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
    check_contains(judge(reading).text, "in use fp16");
    reading = carry(SB_CARRIER_SAMPLER, 1, &(struct format){.half = true});
    reading.used = 1;
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
    check_contains(judge(reading).text, "partly");
}

static void a_mixture_on_a_carrier_is_named_value_by_value(void **state)
{
    (void)state;
    struct sb_precision_reading reading =
        carry(SB_CARRIER_OUTPUT, 1, &(struct format){.half = false});
    reading.square = INFINITY;
    const struct sb_precision_verdict verdict = judge(reading);
    assert_int_equal(verdict.effective, SB_EFFECTIVE_OTHER);
    assert_string_equal(verdict.text,
                        "partly: 2049 fp32, 65536 fp16, rounding fp32, 2^-20 kept");
}

static void an_interpolated_value_may_be_some_ulp_off(void **state)
{
    (void)state;
    struct sb_precision_reading reading =
        carry(SB_CARRIER_VARYING, 1, &(struct format){.half = false});
    reading.add = 2 * nextafterf(2049, 0) - 2048;
    reading.square = nextafterf(256, 0);
    reading.tiny = nextafterf(1, 2);
    reading.round = nextafterf(1 + 0x1.8p-11f, 2) - 1;
    reading.used = 1 - 0x1p-21f;
    assert_string_equal(judge(reading).text, "ignored: fp32");
    reading.add = 2049.5f;
    assert_int_equal(judge(reading).effective, SB_EFFECTIVE_OTHER);
}

static void the_questions_are_every_carrier_of_each_stage_at_each_precision_once(
    void **state)
{
    (void)state;
    struct sb_precision_reading question[SB_PRECISION_MAX];
    bool seen[2][SB_CARRIER_COUNT][SB_PRECISION_COUNT] = {{{false}}};
    const int count = sb_precision_questions(question);
    assert_int_equal(count, SB_PRECISION_COUNT * (2 * SB_CARRIER_COUNT - 1));
    for (int i = 0; i < count; i++) {
        const struct sb_precision_reading *q = &question[i];
        bool *once = &seen[q->vertex_stage][q->carrier][q->precision];
        assert_false(*once);
        *once = true;
        assert_true(isnan(q->add) && isnan(q->lone) && isnan(q->used));
        assert_false(q->vertex_stage && q->carrier == SB_CARRIER_OUTPUT);
        // What was never answered is no format.
        assert_int_equal(judge(*q).effective, SB_EFFECTIVE_OTHER);
    }
    assert_string_equal(sb_precision_names[1], "mediump");
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
        cmocka_unit_test(a_lone_operation_that_is_folded_is_said_to_be),
        cmocka_unit_test(every_carrier_is_judged_by_the_rules_of_its_format),
        cmocka_unit_test(a_carrier_that_only_arithmetic_rounds_is_ignored_and_said_to_be),
        cmocka_unit_test(a_mixture_on_a_carrier_is_named_value_by_value),
        cmocka_unit_test(an_interpolated_value_may_be_some_ulp_off),
        cmocka_unit_test(
            the_questions_are_every_carrier_of_each_stage_at_each_precision_once),
    };
    return run_tests(tests);
}
