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

static void both_stages_are_probed_at_every_precision(void **state)
{
    (void)state;
    assert_int_equal(probe.count, 6);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(probe.reading[i].vertex_stage, i / 3);
        assert_int_equal(probe.reading[i].precision, i % 3);
    }
}

static void highp_computes_in_single_precision(void **state)
{
    (void)state;
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        if (!single_by_specification(r))
            continue;
        check_close(r->add, 2050, 0);
        check_close(r->square, 256, 256 * 0x1p-21); // a division may be 2.5 ulp off
        check_close(r->tiny, 1, 0);
        check_close(r->round, 1.5 * 0x1p-11, 0);
    }
}

static void the_judge_calls_highp_single_precision(void **state)
{
    (void)state;
    for (int i = 0; i < probe.count; i++) {
        struct sb_precision_verdict verdict;
        sb_precision_judge(&probe.reading[i], &verdict);
        print_message("%s %d: %s\n", i / 3 ? "vertex" : "fragment",
                      probe.reading[i].precision, verdict.text);
        if (single_by_specification(&probe.reading[i]))
            assert_int_equal(verdict.effective, SB_EFFECTIVE_FP32);
    }
}

static void every_result_was_written(void **state)
{
    (void)state;
    for (int i = 0; i < probe.count; i++) {
        const struct sb_precision_reading *r = &probe.reading[i];
        // max takes either operand where one is a NaN (GLSL 4.60, 8.3): 1 or the NaN.
        assert_true(isnan(r->nan_left) || r->nan_left == 1);
        assert_true(isnan(r->nan_right) || r->nan_right == 1);
        // pow(0, 0) is undefined: what exp2(0 * log2(0)) gives, 1, or 0.
        assert_true(isnan(r->pow_zero) || r->pow_zero == 1 || r->pow_zero == 0);
        assert_true(r->add != 0 && r->square != 0);
    }
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_stages_are_probed_at_every_precision),
        cmocka_unit_test(highp_computes_in_single_precision),
        cmocka_unit_test(the_judge_calls_highp_single_precision),
        cmocka_unit_test(every_result_was_written),
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
