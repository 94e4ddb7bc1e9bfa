#include "gl/audit.h"
#include "gl_test.h"
#include "test.h"

static struct gl_test test;
static struct sb_probe probe;

// highp is IEEE single precision (GLSL ES 3.00, 4.5.1), in both stages; desktop OpenGL
// reads the qualifiers and ignores them (GLSL 3.30, 4.5).
static bool single_by_specification(const struct sb_precision_reading *reading)
{
    return reading->precision == 0 || !test.caps.gles;
}

static const struct sb_precision_reading *reading_of(bool vertex_stage,
                                                     enum sb_carrier carrier,
                                                     int precision)
{
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        if (r->vertex_stage == vertex_stage && r->carrier == carrier &&
            r->precision == precision)
            return r;
    }
    return NULL;
}

static void all_carriers_of_both_stages_are_probed_at_every_precision(void **state)
{
    (void)state;
    struct sb_precision_reading question[SB_PRECISION_MAX];
    const int count = sb_precision_questions(question);
    int probed = 0;
    for (int i = 0; i < count; i++) {
        const bool there = reading_of(question[i].vertex_stage, question[i].carrier,
                                      question[i].precision) != NULL;
        probed += there;
        assert_true(there || (question[i].carrier == SB_CARRIER_OUTPUT &&
                              !test.caps.colour_float));
    }
    assert_int_equal(probed, probe.count);
}

static void highp_is_single_precision_on_every_carrier(void **state)
{
    (void)state;
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        if (!single_by_specification(r))
            continue;
        check_close(r->add, 2050, 2050 * 0x1p-21);
        check_close(r->square, 256, 256 * 0x1p-21); // a division may be 2.5 ulp off
        check_close(r->tiny, 1, 0x1p-21);
        check_close(r->round, 1.5 * 0x1p-11, 0x1p-21);
        if (r->carrier == SB_CARRIER_ARITHMETIC)
            check_close(r->lone, 2049, 0);
        if (!isnan(r->used))
            check_close(r->used, 1, 0x1p-21);
    }
}

static void the_judge_calls_highp_single_precision(void **state)
{
    (void)state;
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        struct sb_precision_verdict verdict;
        sb_precision_judge(r, &verdict);
        print_message("%s %s %s: %s\n", r->vertex_stage ? "vertex" : "fragment",
                      sb_carriers[r->carrier].name, sb_precision_names[r->precision],
                      verdict.text);
        if (single_by_specification(r)) {
            assert_int_equal(verdict.effective, SB_EFFECTIVE_FP32);
            assert_false(verdict.rounded_in_use);
        }
    }
}

static void every_result_was_written(void **state)
{
    (void)state;
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        assert_true(r->add > 0 && r->square > 0 && r->tiny >= 0 && r->round >= 0);
        if (r->carrier != SB_CARRIER_ARITHMETIC) {
            // A varying that the reading stage declares at highp has no use below it.
            assert_int_equal(isnan(r->used),
                             r->carrier == SB_CARRIER_OUTPUT ||
                                 (r->carrier == SB_CARRIER_VARYING && r->vertex_stage));
            assert_true(isnan(r->lone));
            continue;
        }
        // max takes either operand where one is a NaN (GLSL 4.60, 8.3): 1 or the NaN.
        assert_true(isnan(r->nan_left) || r->nan_left == 1);
        assert_true(isnan(r->nan_right) || r->nan_right == 1);
        // pow(0, 0) is undefined: what exp2(0 * log2(0)) gives, 1, or 0.
        assert_true(isnan(r->pow_zero) || r->pow_zero == 1 || r->pow_zero == 0);
        assert_true(r->lone > 0);
    }
}

// Mesa's llvmpipe computes in binary16 where the processor converts it (lp_has_fp16).
static bool computes_in_half(void)
{
#if defined(__x86_64__) || defined(__i386__)
    const bool converts = __builtin_cpu_supports("f16c");
#elif defined(__aarch64__)
    const bool converts = true;
#else
    const bool converts = false;
#endif
    return converts && test.caps.gles && strncmp(test.caps.renderer, "llvmpipe", 8) == 0;
}

static void llvmpipe_under_gles_computes_mediump_in_half_floats(void **state)
{
    (void)state;
    if (!computes_in_half())
        skip();
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        struct sb_precision_verdict verdict;
        sb_precision_judge(r, &verdict);
        if (r->precision == 0)
            continue;
        if (r->carrier == SB_CARRIER_ARITHMETIC) {
            assert_int_equal(verdict.effective, SB_EFFECTIVE_FP16);
            assert_true(verdict.overflow_inf && verdict.subnormals &&
                        verdict.round_nearest);
        }
        // Whatever the carrier keeps, arithmetic of half floats rounds what it takes.
        if (!isnan(r->used))
            check_close(r->used, 0, 0);
    }
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_carriers_of_both_stages_are_probed_at_every_precision),
        cmocka_unit_test(highp_is_single_precision_on_every_carrier),
        cmocka_unit_test(the_judge_calls_highp_single_precision),
        cmocka_unit_test(every_result_was_written),
        cmocka_unit_test(llvmpipe_under_gles_computes_mediump_in_half_floats),
    };
    gl_test_open(&test);
    struct sb_error err = {0};
    if (!sb_gl_probe_precision(&test.caps, &probe, &err)) {
        print_error("%s\n", err.text);
        return 1;
    }
    const int failed = run_tests(tests);
    gl_test_close(&test);
    return failed;
}
