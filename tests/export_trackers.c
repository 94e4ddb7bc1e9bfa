// What services that keep a history read: github-action-benchmark and Bencher, by the shape that each
// documents.
#include "export_json.h"

// customSmallerIsBetter: name, unit and value, and texts for the rest.
static void check_action_shape(const json_t *list)
{
    size_t i;
    const json_t *it, *value;
    const char *key;
    assert_true(json_is_array(list));
    json_array_foreach(list, i, it)
    {
        assert_true(json_is_string(json_object_get(it, "name")));
        assert_true(json_is_string(json_object_get(it, "unit")));
        assert_true(json_is_number(json_object_get(it, "value")));
        json_object_foreach((json_t *)it, key, value)
        {
            static const char *const known[] = {"name", "unit", "value", "range",
                                                "extra"};
            bool found = false;
            for (int k = 0; k < 5; k++)
                found |= strcmp(known[k], key) == 0;
            assert_true(found);
            assert_true(strcmp(key, "value") == 0 || json_is_string(value));
        }
    }
}

static void the_action_gets_a_ratio_and_a_time_only_where_there_is_none(void **state)
{
    (void)state;
    json_t *json = written_json("github-action-benchmark", &run_export);
    check_action_shape(json);
    assert_int_equal(json_array_size(json), 2); // BROKEN and LATE have no time
    check_string(json, "0.name", "room/point=8,stage=fragment");
    check_string(json, "0.unit", "ratio");
    check_number(json, "0.value", 1.25);
    check_string(json, "0.range", "± 20.0%"); // the wider side: 0.25 of 1.25
    check_string(json, "0.extra",
                 "ms a frame: 2.5 [2, 3.5], ratio: 1.25 [1.125, 1.5]\n"
                 "samples: 4 of 7 frames\nok\nrenderer: pipe | \"r\" <1>\nseed: 1");
    check_string(json, "1.unit", "ns/frame");
    check_number(json, "1.value", 1.5e6);
    check_absent(json, "1.range");
    json_decref(json);
    json = written_json("github-action-benchmark", &pair_export);
    check_action_shape(json);
    assert_int_equal(json_array_size(json), 2); // heads alone
    check_string(json, "0.name", "head/room/point=8");
    check_string(json, "0.unit", "ratio");
    json_decref(json);
}

// The action fails a job on an empty list.
static void the_action_gets_ratios_of_what_was_not_timed(void **state)
{
    (void)state;
    json_t *json = written_json("github-action-benchmark", &untimed_export);
    check_action_shape(json);
    assert_int_equal(json_array_size(json), 2);
    check_string(json, "0.name", "head/room/point=8");
    check_string(json, "0.unit", "ratio");
    check_number(json, "0.value", 1.05);
    check_string(json, "0.extra",
                 "instructions a frame: 1050000, ratio: 1.05 [1.04, 1.06]\n"
                 "samples: 2 of 1 frames\npass");
    check_string(json, "1.name", "head/room/point=1");
    check_string(json, "1.unit", "ratio");
    check_number(json, "1.value", 1);
    check_absent(json, "1.range");
    check_string(json, "1.extra", "base and head are the same program\nskipped");
    json_decref(json);
}

// bencher.dev/bmf.json: objects of objects, of which each has a number `value`, and maybe two more.
static void check_bmf(const json_t *json)
{
    const char *benchmark, *name, *key;
    const json_t *measures, *measure, *value;
    assert_true(json_is_object(json));
    json_object_foreach((json_t *)json, benchmark, measures)
    {
        assert_in_range(strlen(benchmark), 1, 1024);
        assert_true(json_is_object(measures));
        json_object_foreach((json_t *)measures, name, measure)
        {
            assert_in_range(strlen(name), 1, 64);
            assert_true(json_is_number(json_object_get(measure, "value")));
            json_object_foreach((json_t *)measure, key, value)
            {
                assert_true(strcmp(key, "value") == 0 ||
                            strcmp(key, "lower_value") == 0 ||
                            strcmp(key, "upper_value") == 0);
                assert_true(json_is_number(value));
            }
        }
    }
}

static void bencher_gets_latency_with_its_interval_and_more_measures(void **state)
{
    (void)state;
    json_t *json = written_json("bencher", &run_export);
    check_bmf(json);
    assert_int_equal(json_object_size(json), 2);
    const json_t *room = json_object_get(json, "room/point=8,stage=fragment");
    check_number(room, "latency.value", 2.5e6);
    check_number(room, "latency.lower_value", 2e6);
    check_number(room, "latency.upper_value", 3.5e6);
    check_number(room, "cpu-time.value", 2e6);
    check_number(room, "ratio.lower_value", 1.125);
    check_number(room, "max-err.value", 0.25);
    check_absent(room, "flip-mean");
    const json_t *plane =
        json_object_get(json, "plane/form=\"a, b\",<c>&d|e f/g é\xEF\xBF\xBD");
    check_number(plane, "latency.value", 1.5e6);
    assert_int_equal(json_object_size(json_object_get(plane, "latency")), 1);
    assert_int_equal(json_object_size(plane), 1);
    json_decref(json);
    json = written_json("bencher", &pair_export);
    check_bmf(json);
    assert_int_equal(json_object_size(json), 4);
    json_decref(json);
}

static void bencher_gets_counts_and_their_ratio_without_a_latency(void **state)
{
    (void)state;
    json_t *json = written_json("bencher", &untimed_export);
    check_bmf(json);
    assert_int_equal(json_object_size(json), 2);
    const json_t *head = json_object_get(json, "head/room/point=8");
    assert_int_equal(json_object_size(head), 2);
    check_number(head, "ratio.value", 1.05);
    check_number(head, "ratio.upper_value", 1.06);
    check_number(head, "instructions.value", 1050000);
    const json_t *base = json_object_get(json, "base/room/point=8");
    assert_int_equal(json_object_size(base), 1);
    check_number(base, "instructions.value", 1000001);
    json_decref(json);
}

static void names_that_are_too_long_for_bencher_are_cut_and_still_differ(void **state)
{
    (void)state;
    char ids[2][1500];
    struct sb_export_row rows[2] = {run_rows[OK], run_rows[OK]};
    for (int i = 0; i < 2; i++) {
        for (size_t c = 0; c + 2 < sizeof ids[i]; c += 2)
            memcpy(ids[i] + c, "é", 3); // may be cut in half
        ids[i][sizeof ids[i] - 2] = (char)('a' + i);
        ids[i][sizeof ids[i] - 1] = '\0';
        rows[i].variant = ids[i];
    }
    json_t *json =
        written_json("bencher", &(struct sb_export){.row = rows, .row_count = 2});
    check_bmf(json);
    assert_int_equal(json_object_size(json), 2);
    json_decref(json);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_action_gets_a_ratio_and_a_time_only_where_there_is_none),
        cmocka_unit_test(the_action_gets_ratios_of_what_was_not_timed),
        cmocka_unit_test(bencher_gets_counts_and_their_ratio_without_a_latency),
        cmocka_unit_test(bencher_gets_latency_with_its_interval_and_more_measures),
        cmocka_unit_test(names_that_are_too_long_for_bencher_are_cut_and_still_differ),
    };
    return run_tests(tests);
}
