// Google Benchmark's JSON: the fields that its readers look for, and figures worked out by hand.
#include "export_json.h"

// The entry of that name, the `skip`-th.
static const json_t *entry(const json_t *json, const char *name, int skip)
{
    size_t i;
    const json_t *it;
    json_array_foreach(json_object_get(json, "benchmarks"), i, it)
    {
        const char *own = json_string_value(json_object_get(it, "name"));
        assert_non_null(own);
        if (strcmp(own, name) == 0 && skip-- == 0)
            return it;
    }
    fail_msg("no entry %s", name);
    return NULL;
}

static void the_context_has_the_schema_and_properties_by_their_types(void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json", &run_export);
    const json_t *context = json_object_get(json, "context");
    assert_true(json_is_array(json_object_get(context, "caches"))); // Bencher wants it
    check_number(context, "json_schema_version", 1);
    check_string(context, "executable", "shadebench");
    check_string(context, "renderer", "pipe | \"r\" <1>");
    assert_true(json_is_integer(json_object_get(context, "num_cpus")));
    check_number(context, "load_avg.1", 0.25);
    assert_int_equal(json_array_size(json_object_get(context, "load_avg")), 3);
    check_absent(context, "cpu");
    json_decref(json);
}

static void every_sample_is_a_repetition(void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json", &run_export);
    for (int i = 0; i < 4; i++) {
        const json_t *it = entry(json, "room/point=8,stage=fragment", i);
        check_string(it, "run_type", "iteration");
        check_string(it, "run_name", "room/point=8,stage=fragment");
        check_number(it, "repetitions", 4);
        check_number(it, "repetition_index", i);
        check_number(it, "family_index", OK);
        check_number(it, "iterations", 7);
        check_number(it, "threads", 1);
        check_number(it, "real_time", (i + 1) * 1e6);
        check_number(it, "cpu_time", i < 3 ? 2e6 : 6e6);
        check_string(it, "time_unit", "ns");
        check_absent(it, "aggregate_name");
        check_absent(it, "max_err");
    }
    json_decref(json);
}

// Of 1, 2, 3, 4: mean 5/2, deviation sqrt(5/3); of 2, 2, 2, 6: 3 and 2.
static void aggregates_are_those_of_the_samples_and_counters_stand_at_the_median(
    void **state)
{
    (void)state;
    static const struct {
        const char *name, *unit;
        double real, cpu;
    } wanted[] = {
        {"mean", "time", 2.5e6, 3e6},
        {"median", "time", 2.5e6, 2e6},
        {"stddev", "time", 1290994.4487358056, 2e6},
        {"cv", "percentage", 0.51639777949432225, 2.0 / 3},
    };
    json_t *json = written_json("gbench-json", &run_export);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        char name[64];
        snprintf(name, sizeof name, "room/point=8,stage=fragment_%s", wanted[i].name);
        const json_t *it = entry(json, name, 0);
        check_string(it, "run_type", "aggregate");
        check_string(it, "run_name", "room/point=8,stage=fragment");
        check_string(it, "aggregate_name", wanted[i].name);
        check_string(it, "aggregate_unit", wanted[i].unit);
        check_number(it, "iterations", 4);
        check_number(it, "real_time", wanted[i].real);
        check_number(it, "cpu_time", wanted[i].cpu);
        check_absent(it, "repetition_index");
    }
    const json_t *median = entry(json, "room/point=8,stage=fragment_median", 0);
    check_number(median, "ci_lo_ns", 2e6);
    check_number(median, "ci_hi_ns", 3.5e6);
    check_number(median, "ratio", 1.25);
    check_number(median, "ratio_hi", 1.5);
    check_number(median, "max_err", 0.25);
    check_absent(median, "flip_mean");
    check_absent(median, "label"); // "ok" is none
    json_decref(json);
}

static void a_row_without_samples_has_one_entry_and_its_status_is_a_label(void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json", &run_export);
    const char *name = "plane/form=\"a, b\",<c>&d|e f/g é\xEF\xBF\xBD";
    char median[96];
    snprintf(median, sizeof median, "%s_median", name);
    check_number(entry(json, name, 0), "real_time", 1.5e6);
    check_number(entry(json, name, 0), "cpu_time", 0); // there is no way to say unknown
    check_number(entry(json, name, 0), "repetitions", 1);
    check_string(entry(json, median, 0), "label", "not_fragment_bound");
    check_absent(entry(json, median, 0), "ratio");
    check_absent(entry(json, median, 0), "ci_lo_ns");
    json_decref(json);
}

static void what_has_no_time_says_why_and_has_times_for_readers_that_want_some(
    void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json", &run_export);
    const json_t *broken = entry(json, "room/point=9", 0);
    assert_true(json_is_true(json_object_get(broken, "error_occurred")));
    check_string(broken, "error_message",
                 "compile_failed: 0:1: 'x' : \"syntax\"\terror & more");
    check_number(broken, "real_time", 0);
    check_number(broken, "cpu_time", 0);
    const json_t *late = entry(json, "room/point=10", 0);
    assert_true(json_is_true(json_object_get(late, "skipped")));
    check_string(late, "skip_message", "not_measured");
    check_absent(late, "error_occurred");
    json_decref(json);
}

static void what_was_counted_is_skipped_and_says_so(void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json", &untimed_export);
    assert_int_equal(json_array_size(json_object_get(json, "benchmarks")), 2);
    const json_t *head = entry(json, "head/room/point=8", 0);
    assert_true(json_is_true(json_object_get(head, "skipped")));
    check_string(head, "skip_message",
                 "pass; no time, but instructions a frame: 1050000, "
                 "ratio: 1.05 [1.04, 1.06]");
    json_decref(json);
}

// Readers take each entry for a time of which less is better, which no spread is.
static void aggregates_alone_are_levels_of_what_has_a_time(void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json-aggregates", &run_export);
    const json_t *list = json_object_get(json, "benchmarks"), *it;
    size_t i;
    assert_int_equal(json_array_size(list), 2 + 1);
    json_array_foreach(list, i, it) check_string(it, "run_type", "aggregate");
    check_string(list, "0.aggregate_name", "mean");
    check_string(list, "1.aggregate_name", "median");
    check_string(list, "2.aggregate_name", "median");
    json_decref(json);
}

static void the_sides_of_a_pair_are_told_apart_by_name(void **state)
{
    (void)state;
    json_t *json = written_json("gbench-json", &pair_export);
    check_number(entry(json, "base/room/point=8", 0), "real_time", 2e6);
    check_number(entry(json, "head/room/point=8", 0), "real_time", 2.5e6);
    check_string(entry(json, "head/room/point=8_median", 0), "label", "regression");
    json_decref(json);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_context_has_the_schema_and_properties_by_their_types),
        cmocka_unit_test(every_sample_is_a_repetition),
        cmocka_unit_test(
            aggregates_are_those_of_the_samples_and_counters_stand_at_the_median),
        cmocka_unit_test(a_row_without_samples_has_one_entry_and_its_status_is_a_label),
        cmocka_unit_test(
            what_has_no_time_says_why_and_has_times_for_readers_that_want_some),
        cmocka_unit_test(what_was_counted_is_skipped_and_says_so),
        cmocka_unit_test(aggregates_alone_are_levels_of_what_has_a_time),
        cmocka_unit_test(the_sides_of_a_pair_are_told_apart_by_name),
    };
    return run_tests(tests);
}
