// What a gate makes of times: each verdict, at what cost, and with which exit code.

#include "gate_fixture.h"

static void an_unchanged_variant_passes(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "pass", "ok");
        assert_string_equal(gate.result.row[i].picture, "equal");
        assert_true(isnan(gate.result.row[i].confirm_ratio));
        assert_true(gate.result.row[i].pairs < 240); // it stops when it is sure
    }
    assert_int_equal(gate.result.exit_code, 0);
    assert_int_equal(gate.result.count[SB_GATE_PASS], VARIANTS);
    assert_int_equal(gate.result.rule.variants, VARIANTS);
    assert_int_equal(script.opened, 1);
    gate_end(&gate);
}

static void five_percent_are_a_regression_that_a_fresh_session_confirms(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.slower[1] = script.slower_fresh[1] = 0.05;
    gate_run_good(&gate);
    const struct sb_gate_row *row = &gate.result.row[1];
    check_row(&gate, 0, "pass", "ok");
    check_row(&gate, 1, "regression", "ok");
    check_row(&gate, 2, "pass", "ok");
    assert_int_equal(gate.result.exit_code, 1);
    check_close(row->ratio, 1.05, 0.01);
    assert_true(row->ratio_lo < 1.05 && row->ratio_hi > 1.05);
    assert_true(row->p_slower < 0.05 / VARIANTS / 5);
    check_close(row->confirm_ratio, 1.05, 0.005);
    assert_true(row->confirm_p < 0.05);
    check_close(row->base_ms, 2, 0.02); // a frame
    check_close(row->head_ms, 2.1, 0.02);
    assert_int_equal(script.opened, 2); // the one candidate, and nobody else
    gate_end(&gate);
}

static void what_a_fresh_session_does_not_find_is_not_confirmed(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.slower[0] = script.slower[2] = 0.05;
    script.slower_fresh[2] = 0.019; // under the tolerance, though over nothing
    gate_run_good(&gate);
    check_row(&gate, 0, "not-confirmed", "ok");
    check_row(&gate, 1, "pass", "ok");
    check_row(&gate, 2, "not-confirmed", "ok");
    check_close(gate.result.row[0].ratio, 1.05, 0.01);
    check_close(gate.result.row[0].confirm_ratio, 1, 0.005);
    check_close(gate.result.row[2].confirm_ratio, 1.019, 0.005);
    assert_int_equal(gate.result.exit_code, 0);
    assert_int_equal(script.opened, 3); // a session each
    gate_end(&gate);
}

static void what_became_faster_is_improved(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.01;
    script.slower[2] = -0.1;
    script.slower[1] = -0.005; // within the tolerance: it passes
    gate_run_good(&gate);
    check_row(&gate, 1, "pass", "ok");
    check_row(&gate, 2, "improved", "ok");
    assert_int_equal(gate.result.exit_code, 0);
    assert_int_equal(script.opened, 1); // what is faster needs no confirmation
    gate_end(&gate);
}

static void what_is_at_the_tolerance_is_inconclusive_when_the_pairs_end(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.03;
    script.slower[0] = 0.02;
    gate_run_good(&gate);
    check_row(&gate, 0, "inconclusive", "ok");
    assert_int_equal(gate.result.row[0].pairs, 240);
    check_close(gate.result.row[0].alpha_spent, 0.05 / VARIANTS, 1e-12);
    assert_int_equal(gate.result.exit_code, 0); // --fail-on-inconclusive is the caller's
    gate_end(&gate);
}

static void the_budget_ends_a_gate_with_the_pairs_it_has(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    script.noise = 0.05;
    script.sleep_ns = 2000000;
    assert_true(sb_measure_set(&gate.suite.measure, "budget", "0.2", &gate.err));
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "inconclusive", "ok");
        assert_in_range(gate.result.row[i].pairs, 1, 100);
    }
    assert_int_equal(gate.result.exit_code, 0);
    gate_end(&gate);
}

static void equal_sources_are_skipped_and_said_so(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    gate.params.keep_equal = false;
    gate.params.side[SB_HEAD].renamed = false;
    script.slower[0] = 0.5; // nobody will know
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        const struct sb_gate_row *row = &gate.result.row[i];
        check_row(&gate, i, "skipped", "ok");
        check_contains(row->note, "equal");
        assert_string_equal(row->base_source, row->head_source);
        assert_int_equal(row->pairs, SB_NO_COUNT);
    }
    assert_int_equal(gate.result.exit_code, 0);
    assert_int_equal(script.shots, 0);
    assert_int_equal(gate.result.count[SB_GATE_SKIPPED], VARIANTS);
    gate_end(&gate);

    gate_begin(&gate); // with keep_equal
    gate.params.side[SB_HEAD].renamed = false;
    gate_run_good(&gate);
    check_row(&gate, 0, "pass", "ok");
    assert_string_equal(gate.result.row[0].base_source, gate.result.row[0].head_source);
    gate_end(&gate);
}

// What differs is timed, and only that: the family is as small as it can be.
static void only_variants_whose_texts_differ_are_of_the_family(void **state)
{
    (void)state;
    struct gate gate;
    char line[256];
    gate_begin(&gate);
    gate.params.keep_equal = false;
    gate.params.side[SB_HEAD].renamed = false;
    copy_shaders(&gate.head);
    snprintf(line, sizeof line, "sed -i '$a // a comment' '%s'/model/*.glsl",
             gate.head.root);
    assert_int_equal(system(line), 0);
    gate.params.side[SB_HEAD].shaders = gate.head.root;
    gate_run_good(&gate);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "pass", "ok");
        assert_string_not_equal(gate.result.row[i].base_source,
                                gate.result.row[i].head_source);
    }
    assert_int_equal(gate.result.rule.variants, VARIANTS);
    gate_end(&gate);
}

static void a_selftest_tells_the_bias_and_refuses_a_tolerance_under_twice_that(
    void **state)
{
    (void)state;
    static const struct {
        double bias, tolerance;
        bool tolerable;
    } cases[] = {{0, 0.02, true},
                 {0.008, 0.02, true},
                 {0.012, 0.02, false},
                 {0.012, 0.03, true},
                 {-0.03, 0.05, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct gate gate;
        gate_begin(&gate);
        gate.params.selftest = true;
        gate.params.rule.tolerance = cases[i].tolerance;
        script.noise = 0.0002;
        script.slower[1] = cases[i].bias;
        gate_run_good(&gate);
        const struct sb_gate_bias *bias = &gate.result.bias;
        check_close(bias->bias, fabs(cases[i].bias), 2e-4);
        assert_int_equal(bias->tolerable, cases[i].tolerable);
        assert_int_equal(gate.result.exit_code, cases[i].tolerable ? 0 : 3);
        for (int v = 0; v < VARIANTS; v++) {
            assert_null(gate.result.row[v].verdict);
            assert_int_equal(gate.result.row[v].pairs, 120);
        }
        if (cases[i].bias != 0)
            assert_int_equal(bias->variant, 1);
        assert_int_equal(script.opened, 1); // no verdict, no confirmation
        gate_end(&gate);
    }
}

// CPU time, where the context says that a CPU draws; what a null runner has is a timer.
static void the_metric_is_the_one_that_was_asked_for(void **state)
{
    (void)state;
    static const enum sb_metric metrics[] = {SB_METRIC_AUTO, SB_METRIC_CPU,
                                             SB_METRIC_WALL};
    static const char *const names[] = {"gpu", "cpu", "wall"};
    for (int i = 0; i < 3; i++) {
        struct gate gate;
        gate_begin(&gate);
        gate.params.metric = metrics[i];
        script.noise = 0.001;
        gate_run_good(&gate);
        check_row(&gate, 0, "pass", "ok");
        assert_string_equal(gate.result.row[0].metric, names[i]);
        // The null runner's CPU time is a tenth of the rest.
        check_close(gate.result.row[0].base_ms, i == 1 ? 0.1 : 1, 0.01);
        gate_end(&gate);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_unchanged_variant_passes),
        cmocka_unit_test(five_percent_are_a_regression_that_a_fresh_session_confirms),
        cmocka_unit_test(what_a_fresh_session_does_not_find_is_not_confirmed),
        cmocka_unit_test(what_became_faster_is_improved),
        cmocka_unit_test(what_is_at_the_tolerance_is_inconclusive_when_the_pairs_end),
        cmocka_unit_test(the_budget_ends_a_gate_with_the_pairs_it_has),
        cmocka_unit_test(equal_sources_are_skipped_and_said_so),
        cmocka_unit_test(only_variants_whose_texts_differ_are_of_the_family),
        cmocka_unit_test(
            a_selftest_tells_the_bias_and_refuses_a_tolerance_under_twice_that),
        cmocka_unit_test(the_metric_is_the_one_that_was_asked_for),
    };
    return run_tests(tests);
}
