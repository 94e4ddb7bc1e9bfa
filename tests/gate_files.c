// What a gate leaves on disk is all that its verdicts stand on, and is there however it ended.
#include <sys/resource.h>

#include "gate_fixture.h"
#include "measure/interrupt.h"

// The pairs of a variant in a process, as sb_gate_read takes them.
struct column {
    double base[512], head[512];
    int count;
};
static void gather(const struct sb_pair_row *pair, int count, const char *variant,
                   bool fresh, struct column *column)
{
    column->count = 0;
    for (int i = 0; i < count; i++)
        if (strcmp(pair[i].variant, variant) == 0 && (pair[i].process > 0) == fresh &&
            pair[i].base != SB_NO_COUNT && pair[i].head != SB_NO_COUNT) {
            column->base[column->count] = (double)pair[i].base;
            column->head[column->count++] = (double)pair[i].head;
        }
}

// Nothing but pairs.csv and the rule: verdict, ratio and p of each row.
static void check_reproduced(const struct gate *gate)
{
    struct sb_csv csv;
    int count;
    struct sb_pair_row *pair = read_pairs(gate, &count, &csv);
    for (int i = 0; i < VARIANTS; i++) {
        static struct column column;
        static double scratch[4 * 512];
        const struct sb_gate_row *row = &gate->result.row[i];
        gather(pair, count, row->variant, false, &column);
        struct sb_gate_reading reading =
            sb_gate_read(&gate->result.rule, column.base, column.head, NULL, column.count,
                         true, scratch);
        assert_int_equal(reading.n, row->pairs);
        check_close(reading.ratio.point, row->ratio, 0);
        check_close(reading.ratio.lo, row->ratio_lo, 0);
        check_close(reading.p_slower, row->p_slower, 0);
        check_close(reading.p_within, row->p_within, 0);
        check_close(reading.mde, row->mde, 0);
        if (reading.verdict == SB_GATE_CANDIDATE) {
            gather(pair, count, row->variant, true, &column);
            reading = sb_gate_confirm(&gate->result.rule, column.base, column.head, NULL,
                                      column.count, true, scratch);
            check_close(reading.p_slower, row->confirm_p, 0);
            check_close(reading.ratio.point, row->confirm_ratio, 0);
        }
        assert_string_equal(sb_gate_verdict_rows[reading.verdict].word, row->verdict);
    }
    free(pair);
    sb_csv_free(&csv);
}

static void pairs_csv_alone_gives_every_verdict(void **state)
{
    (void)state;
    struct gate gate;
    int code;
    gate_begin(&gate);
    script.noise = 0.02;
    script.slower[0] = script.slower_fresh[0] = 0.05;
    script.slower[1] = 0.06;
    script.slower[2] = -0.08;
    gate_run_good(&gate);
    check_row(&gate, 0, "regression", "ok");
    check_row(&gate, 1, "not-confirmed", "ok");
    check_row(&gate, 2, "improved", "ok");
    check_reproduced(&gate);
    assert_true(gate_complete(&gate, &code));
    assert_int_equal(code, 1);
    gate_end(&gate);

    gate_begin(&gate);
    script.noise = 0.03;
    script.slower[1] = 0.02;
    gate_run_good(&gate);
    check_row(&gate, 0, "pass", "ok");
    check_row(&gate, 1, "inconclusive", "ok");
    check_reproduced(&gate);
    gate_end(&gate);
}

static void gate_csv_holds_the_rows(void **state)
{
    (void)state;
    struct gate gate;
    struct sb_csv csv;
    struct sb_error err = {0};
    gate_begin(&gate);
    script.noise = 0.01;
    script.slower[1] = script.slower_fresh[1] = 0.07;
    gate_run_good(&gate);
    gate_csv(&gate, "gate.csv", &csv);
    assert_int_equal(csv.row_count, 1 + VARIANTS);
    for (int i = 0; i < VARIANTS; i++) {
        const struct sb_gate_row *row = &gate.result.row[i];
        struct sb_gate_row read;
        sb_gate_row_init(&read);
        if (!sb_csv_get(&csv, i + 1, sb_gate_columns, sb_gate_column_count, &read, &err))
            fail_msg("%s", err.text);
        assert_string_equal(read.variant, row->variant);
        assert_string_equal(read.verdict, row->verdict);
        assert_string_equal(read.status, "ok");
        check_close(read.ratio, row->ratio, 0);
        assert_true(isnan(read.confirm_p) == (i != 1));
        if (i == 1)
            check_close(read.confirm_p, row->confirm_p, 0);
        assert_int_equal(read.pairs, row->pairs);
    }
    sb_csv_free(&csv);
    gate_end(&gate);
}

// Base head, head base: so what favours the first or the second of two batches cancels.
static void each_variant_is_measured_abba_in_batches_of_one_length(void **state)
{
    (void)state;
    struct gate gate;
    struct sb_csv csv;
    int count;
    gate_begin(&gate);
    script.noise = 0.01;
    script.slower[0] = script.slower_fresh[0] = 3; // one batch fits both sides
    gate_run_good(&gate);
    check_row(&gate, 0, "regression", "ok");
    struct sb_pair_row *pair = read_pairs(&gate, &count, &csv);
    for (int v = 0; v < VARIANTS; v++) {
        const char *before = NULL;
        int process = -1, batch = 0, firsts[SB_SIDES] = {0};
        for (int i = 0; i < count; i++) {
            if (strcmp(pair[i].variant, gate.result.row[v].variant) != 0)
                continue;
            if (pair[i].process == process) {
                assert_string_not_equal(pair[i].first, before);
                assert_int_equal(pair[i].batch, batch);
            }
            firsts[strcmp(pair[i].first, "head") == 0]++;
            before = pair[i].first;
            process = (int)pair[i].process;
            batch = (int)pair[i].batch;
        }
        assert_in_range(firsts[SB_BASE] - firsts[SB_HEAD] + 1, 0, 2);
        // Whole frames of v + 1 ms: about two milliseconds of the quicker side.
        assert_in_range(batch, v == 0 ? 2 : 1, v == 0 ? 3 : 2);
    }
    // Each round has each variant that is open, once.
    for (int i = 1; i < count; i++)
        assert_true(pair[i].round >= pair[i - 1].round ||
                    pair[i].process > pair[i - 1].process);
    free(pair);
    sb_csv_free(&csv);
    gate_end(&gate);
}

static void a_folder_with_pairs_is_not_written_over(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    gate_run_good(&gate);
    struct sb_gate_result second = {0};
    struct sb_error err = {0};
    assert_false(sb_gate_run(&gate.params, &second, &err));
    check_contains(err.text, "pairs.csv exists");
    sb_gate_result_free(&second);
    gate_end(&gate);
}

static void limit_files(rlim_t bytes)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

// A limit on the length of files fails as a full disk does.
static void a_full_disk_keeps_whole_rounds_and_judges_by_them(void **state)
{
    (void)state;
    struct gate gate;
    struct sb_csv csv;
    int code;
    gate_begin(&gate);
    script.noise = 0.1;                              // nothing passes so soon
    script.slower[0] = script.slower_fresh[0] = 0.9; // but this is a candidate by then
    signal(SIGXFSZ, SIG_IGN);
    limit_files(6000);
    const bool good = gate_run(&gate);
    limit_files(RLIM_INFINITY);
    assert_false(good);
    assert_int_equal(gate.err.status, SB_WRITE_FAILED);
    check_contains(gate.err.text, "pairs.csv: File too large");
    assert_int_equal(gate.result.exit_code, 3);
    assert_int_equal(gate.result.row_count, VARIANTS);
    check_row(&gate, 0, "inconclusive", "ok"); // nobody could confirm it
    check_contains(gate.result.row[0].note, "slower, but the pairs could not be written");
    check_row(&gate, 1, "inconclusive", "ok");
    // The file ends with a whole line, and the rows say what it says.
    gate_csv(&gate, "pairs.csv", &csv);
    int lines[VARIANTS] = {0};
    const int variant = sb_csv_column(&csv, "variant");
    for (int i = 1; i < csv.row_count; i++)
        for (int v = 0; v < VARIANTS; v++)
            lines[v] += strcmp(csv.cell[i][variant], gate.result.row[v].variant) == 0;
    for (int v = 0; v < VARIANTS; v++) {
        assert_true(lines[v] >= 15);
        assert_int_equal(gate.result.row[v].pairs, lines[v]);
    }
    assert_false(gate_complete(&gate, &code));
    assert_int_equal(code, -1);
    sb_csv_free(&csv);
    gate_end(&gate);
}

static void a_disk_that_is_full_at_once_has_no_ratios(void **state)
{
    (void)state;
    struct gate gate;
    gate_begin(&gate);
    signal(SIGXFSZ, SIG_IGN);
    limit_files(1500); // of gate.json
    const bool good = gate_run(&gate);
    limit_files(RLIM_INFINITY);
    assert_false(good);
    assert_int_equal(gate.err.status, SB_WRITE_FAILED);
    for (int i = 0; i < VARIANTS; i++) {
        check_row(&gate, i, "inconclusive", "ok");
        assert_true(isnan(gate.result.row[i].ratio));
    }
    assert_int_equal(gate.result.exit_code, 3);
    gate_end(&gate);
}

// A signal is caught once in the life of a process: these two are the last, in this order.
static void a_gate_that_is_interrupted_keeps_its_rounds(void **state)
{
    (void)state;
    struct gate gate;
    struct sb_csv csv;
    int code, count;
    gate_begin(&gate);
    script.noise = 0.03;
    script.slower[0] = script.slower_fresh[0] = 0.5;
    script.stop_at = 160; // in the rounds, after the first look
    sb_interrupt_install();
    gate_run_good(&gate);
    assert_true(gate.result.interrupted);
    assert_int_equal(gate.result.exit_code, 130);
    check_row(&gate, 0, "inconclusive", "ok"); // a candidate that nobody confirmed
    check_contains(gate.result.row[0].note, "slower, but interrupted before");
    check_row(&gate, 1, "inconclusive", "ok");
    assert_int_equal(script.opened, 1);
    free(read_pairs(&gate, &count, &csv));
    int pairs = 0;
    for (int i = 0; i < VARIANTS; i++)
        pairs += (int)gate.result.row[i].pairs;
    assert_int_equal(pairs, count);
    assert_true(count > 45);
    assert_false(gate_complete(&gate, &code));
    sb_csv_free(&csv);
    gate_end(&gate);
}

static void a_gate_that_is_interrupted_before_its_rounds_has_judged_nothing(void **state)
{
    (void)state;
    struct gate gate;
    int code;
    assert_true(sb_interrupted()); // since the test before
    gate_begin(&gate);
    gate_run_good(&gate);
    assert_int_equal(gate.result.exit_code, 130);
    for (int i = 0; i < VARIANTS; i++)
        check_row(&gate, i, "inconclusive", "ok");
    assert_false(gate_complete(&gate, &code));
    gate_end(&gate);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_csv_alone_gives_every_verdict),
        cmocka_unit_test(gate_csv_holds_the_rows),
        cmocka_unit_test(each_variant_is_measured_abba_in_batches_of_one_length),
        cmocka_unit_test(a_folder_with_pairs_is_not_written_over),
        cmocka_unit_test(a_full_disk_keeps_whole_rounds_and_judges_by_them),
        cmocka_unit_test(a_disk_that_is_full_at_once_has_no_ratios),
        cmocka_unit_test(a_gate_that_is_interrupted_keeps_its_rounds),
        cmocka_unit_test(a_gate_that_is_interrupted_before_its_rounds_has_judged_nothing),
    };
    return run_tests(tests);
}
