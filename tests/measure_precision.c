// The words of a row for what its terms ask for, and for what a driver makes of them.
#include "test.h"

#include "measure/precision.h"

static struct sb_arena arena;

// "p_vector=mediump" on top of one precision for all. Terms stand on carriers by place, so that
// nothing here depends on the axes.
static struct sb_asked_precision asked_all(int precision)
{
    static const char *const names[SB_PRECISION_TERMS] = {
        "p_position", "p_vector", "p_attenuation", "p_specular", "p_color",
        "p_sum",      "p_output", "p_varying",     "p_uniform",  "p_sampler"};
    static const enum sb_carrier last[] = {SB_CARRIER_OUTPUT, SB_CARRIER_VARYING,
                                           SB_CARRIER_UNIFORM, SB_CARRIER_SAMPLER};
    struct sb_asked_precision asked = {.lowest = precision};
    for (int i = 0; i < SB_PRECISION_TERMS; i++)
        asked.term[i] = (struct sb_asked_term){
            .name = names[i],
            .precision = precision,
            .declared = precision,
            .carrier = i < 6 ? SB_CARRIER_ARITHMETIC : last[i - 6],
        };
    return asked;
}

static void ask(struct sb_asked_precision *asked, int term, int precision)
{
    asked->term[term].precision = asked->term[term].declared = precision;
    if (precision > asked->lowest)
        asked->lowest = precision;
}

// A driver that honours lower precisions as fp16 on the carriers of the mask, in both stages.
static void make_driver(struct sb_driver *driver, unsigned honoured)
{
    *driver = (struct sb_driver){0};
    driver->probe.count = sb_precision_questions(driver->probe.reading);
    for (int i = 0; i < driver->probe.count; i++) {
        const struct sb_precision_reading *reading = &driver->probe.reading[i];
        const bool half = reading->precision > 0 && honoured >> reading->carrier & 1;
        driver->verdict[i].effective = half ? SB_EFFECTIVE_FP16 : SB_EFFECTIVE_FP32;
    }
}

enum {
    NOWHERE = 0,
    EVERYWHERE = (1 << SB_CARRIER_COUNT) - 1,
    IN_ARITHMETIC = 1 << SB_CARRIER_ARITHMETIC
};

static const char *effective(const struct sb_asked_precision *asked, unsigned honoured)
{
    struct sb_driver driver;
    make_driver(&driver, honoured);
    return sb_precision_effective(asked, &driver, &arena);
}

static void one_precision_for_all_is_one_word(void **state)
{
    (void)state;
    static const char *const words[] = {"highp", "mediump", "lowp"};
    static const char *const ignored[] = {"fp32", "fp32 (mediump ignored)",
                                          "fp32 (lowp ignored)"};
    for (int p = 0; p < 3; p++) {
        const struct sb_asked_precision asked = asked_all(p);
        assert_string_equal(sb_precision_requested(&asked, &arena), words[p]);
        assert_string_equal(effective(&asked, EVERYWHERE), p ? "fp16" : "fp32");
        assert_string_equal(effective(&asked, NOWHERE), ignored[p]);
    }
}

static void terms_that_differ_are_named_in_the_order_of_the_axes(void **state)
{
    (void)state;
    struct sb_asked_precision asked = asked_all(0);
    ask(&asked, 1, 1);
    ask(&asked, 4, 2);
    assert_string_equal(sb_precision_requested(&asked, &arena),
                        "highp but p_vector mediump, p_color lowp");
    assert_string_equal(effective(&asked, EVERYWHERE),
                        "fp32 but p_vector fp16, p_color fp16");
    assert_string_equal(effective(&asked, NOWHERE), "fp32 (mediump, lowp ignored)");
    // The highest that is asked for comes first, however few ask for it.
    asked = asked_all(1);
    ask(&asked, 4, 2);
    assert_string_equal(sb_precision_requested(&asked, &arena),
                        "mediump but p_color lowp");
    ask(&asked, 0, 0);
    check_contains(sb_precision_requested(&asked, &arena),
                   "highp but p_vector mediump, p_attenuation mediump,");
}

static void carriers_that_a_driver_ignores_are_named(void **state)
{
    (void)state;
    const struct sb_asked_precision asked = asked_all(1);
    assert_string_equal(
        effective(&asked, IN_ARITHMETIC),
        "fp16 but p_output fp32, p_varying fp32, p_uniform fp32, p_sampler fp32");
    assert_string_equal(effective(&asked, EVERYWHERE & ~(1u << SB_CARRIER_UNIFORM)),
                        "fp16 but p_uniform fp32");
}

static void of_words_that_are_as_common_the_first_leads(void **state)
{
    (void)state;
    struct sb_asked_precision asked = asked_all(0);
    for (int i = 5; i < SB_PRECISION_TERMS; i++)
        ask(&asked, i, 1);
    assert_string_equal(effective(&asked, EVERYWHERE),
                        "fp32 but p_sum fp16, p_output fp16, p_varying fp16, "
                        "p_uniform fp16, p_sampler fp16");
}

static void each_stage_has_its_own_verdict(void **state)
{
    (void)state;
    struct sb_driver driver;
    struct sb_asked_precision asked = asked_all(1);
    make_driver(&driver, EVERYWHERE);
    for (int i = 0; i < driver.probe.count; i++) // as freedreno: the vertex stage is fp32
        if (driver.probe.reading[i].vertex_stage)
            driver.verdict[i].effective = SB_EFFECTIVE_FP32;
    assert_string_equal(sb_precision_effective(&asked, &driver, &arena), "fp16");
    for (int i = 0; i < 6; i++)
        asked.term[i].vertex_stage = true;
    assert_string_equal(
        sb_precision_effective(&asked, &driver, &arena),
        "fp32 but p_output fp16, p_varying fp16, p_uniform fp16, p_sampler fp16");
}

static void what_was_not_probed_or_is_no_format_is_called_that(void **state)
{
    (void)state;
    struct sb_driver driver;
    struct sb_asked_precision asked = asked_all(1);
    make_driver(&driver, EVERYWHERE);
    int kept = 0;
    for (int i = 0; i < driver.probe.count; i++) // no float targets
        if (driver.probe.reading[i].carrier != SB_CARRIER_OUTPUT) {
            driver.verdict[kept] = driver.verdict[i];
            driver.probe.reading[kept++] = driver.probe.reading[i];
        }
    driver.probe.count = kept;
    assert_string_equal(sb_precision_effective(&asked, &driver, &arena),
                        "fp16 but p_output not probed");
    for (int i = 0; i < kept; i++)
        driver.verdict[i].effective = SB_EFFECTIVE_OTHER;
    check_contains(sb_precision_effective(&asked, &driver, &arena), "other but p_output");
    asked = asked_all(0);
    make_driver(&driver, EVERYWHERE);
    driver.probe.count = 0;
    assert_null(sb_precision_effective(&asked, &driver, &arena));
}

static void what_the_program_declares_decides_not_what_was_asked_for(void **state)
{
    (void)state;
    struct sb_asked_precision asked = asked_all(0);
    asked.term[6].declared = 1; // the output of GLSL ES 1.00
    assert_string_equal(sb_precision_requested(&asked, &arena), "highp");
    assert_string_equal(effective(&asked, EVERYWHERE), "fp32 but p_output fp16");
    assert_string_equal(effective(&asked, NOWHERE), "fp32 (mediump ignored)");
}

static void emulated_precision_is_called_emulated(void **state)
{
    (void)state;
    struct sb_asked_precision asked = asked_all(1);
    asked.emulation = SB_EMULATED_FP16;
    assert_string_equal(effective(&asked, NOWHERE), "fp16 emulated");
    asked.emulation = SB_EMULATED_FIXED10;
    ask(&asked, 4, 2);
    assert_string_equal(effective(&asked, NOWHERE),
                        "fp16 emulated, lowp fixed10 emulated");
    // What stays highp is the driver's own.
    asked = asked_all(0);
    asked.emulation = SB_EMULATED_FIXED10;
    assert_string_equal(effective(&asked, NOWHERE), "fp32");
    ask(&asked, 1, 1);
    ask(&asked, 4, 2);
    assert_string_equal(effective(&asked, NOWHERE),
                        "fp32 but p_vector fp16 emulated, p_color fixed10 emulated");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_precision_for_all_is_one_word),
        cmocka_unit_test(terms_that_differ_are_named_in_the_order_of_the_axes),
        cmocka_unit_test(carriers_that_a_driver_ignores_are_named),
        cmocka_unit_test(of_words_that_are_as_common_the_first_leads),
        cmocka_unit_test(each_stage_has_its_own_verdict),
        cmocka_unit_test(what_was_not_probed_or_is_no_format_is_called_that),
        cmocka_unit_test(what_the_program_declares_decides_not_what_was_asked_for),
        cmocka_unit_test(emulated_precision_is_called_emulated),
    };
    const int failed = run_tests(tests);
    sb_arena_free(&arena);
    return failed;
}
