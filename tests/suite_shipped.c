// The suites in bench/: each loads, says why it exists, and is as big as it should be.
#include "test.h"

#include "base/file.h"
#include "suite/suite.h"

static const char bench[] = SB_SOURCE_DIR "/bench";
static struct sb_suite suite;
static struct sb_error err;

static int free_suite(void **state)
{
    (void)state;
    sb_suite_free(&suite);
    return 0;
}

static void load_shipped(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", bench, name);
    sb_suite_free(&suite);
    const struct sb_suite_params params = {.path = path, .data_dir = SB_SOURCE_DIR};
    if (!sb_suite_load(&params, &suite, &err))
        fail_msg("%s", err.text);
}

static void every_shipped_suite_expands_and_wastes_no_entry(void **state)
{
    (void)state;
    struct sb_arena arena = {0};
    int count;
    char **names = sb_dir_list(&arena, bench, ".yaml", &count, &err);
    assert_non_null(names);
    assert_true(count >= 6);
    for (int i = 0; i < count; i++) {
        load_shipped(names[i]);
        assert_int_equal(suite.duplicates, 0);
        assert_true(strlen(suite.about) > 0);
        const size_t length = strlen(suite.name);
        assert_int_equal(strncmp(names[i], suite.name, length), 0);
        assert_string_equal(names[i] + length, ".yaml");
    }
    sb_arena_free(&arena);
}

static double total(const struct sb_variant *v)
{
    return v->value[SB_AXIS_DIR] + v->value[SB_AXIS_POINT] + v->value[SB_AXIS_SPOT];
}

static void lights_is_counts_by_type_by_stage(void **state)
{
    (void)state;
    load_shipped("lights.yaml");
    assert_in_range(suite.entry_count, 24, 30);
    int vertex = 0;
    for (int i = 0; i < suite.entry_count; i++)
        vertex += suite.entry[i].variant.value[SB_AXIS_STAGE] == SB_STAGE_VERTEX;
    assert_int_equal(2 * vertex, suite.entry_count);
}

static void mix_is_always_eight_lights(void **state)
{
    (void)state;
    load_shipped("mix.yaml");
    assert_int_equal(suite.entry_count, 6);
    for (int i = 0; i < suite.entry_count; i++)
        check_close(total(&suite.entry[i].variant), 8, 0);
    assert_string_equal(suite.entry[5].id, "dir=8,point=0,spot=0");
}

static void softpipe_stays_small_enough_for_an_interpreter(void **state)
{
    (void)state;
    load_shipped("softpipe.yaml");
    for (int i = 0; i < suite.entry_count; i++) {
        const struct sb_variant *v = &suite.entry[i].variant;
        assert_true(v->value[SB_AXIS_DRIVER] == SB_DRIVER_SOFTPIPE);
        assert_true(v->value[SB_AXIS_WIDTH] <= 64 && v->value[SB_AXIS_HEIGHT] <= 64);
        assert_true(total(v) <= 8);
    }
}

static void precision_lowers_each_term_alone(void **state)
{
    (void)state;
    load_shipped("precision.yaml");
    int alone[SB_AXIS_BUILTIN_COUNT] = {0};
    for (int i = 0; i < suite.entry_count; i++) {
        int lowered = 0, last = 0;
        for (int axis = SB_AXIS_P_POSITION; axis <= SB_AXIS_P_SAMPLER; axis++)
            if (suite.entry[i].variant.value[axis] != SB_P_POSITION_HIGHP) {
                lowered++;
                last = axis;
            }
        alone[last] += lowered == 1;
    }
    for (int axis = SB_AXIS_P_POSITION; axis <= SB_AXIS_P_SAMPLER; axis++)
        assert_int_equal(alone[axis], 1);
}

// compare --terms needs both ends, and each term changed alone from either.
static void terms_lowers_and_raises_each_term_alone(void **state)
{
    (void)state;
    load_shipped("terms.yaml");
    enum { TERMS = SB_AXIS_P_SAMPLER - SB_AXIS_P_POSITION + 1 };
    int rows[TERMS + 1] = {0}, lowered[TERMS] = {0}, raised[TERMS] = {0};
    for (int i = 0; i < suite.entry_count; i++) {
        const struct sb_variant *v = &suite.entry[i].variant;
        int low = 0, last_low = 0, last_high = 0;
        for (int t = 0; t < TERMS; t++) {
            const bool is_low = v->value[SB_AXIS_P_POSITION + t] != SB_P_POSITION_HIGHP;
            low += is_low;
            *(is_low ? &last_low : &last_high) = t;
        }
        rows[low]++;
        lowered[last_low] += low == 1;
        raised[last_high] += low == TERMS - 1;
        assert_true(v->value[SB_AXIS_TARGET] == SB_TARGET_RGBA32F);
    }
    enum { SCENES = 2 };
    assert_int_equal(rows[0], SCENES);
    assert_int_equal(rows[TERMS], SCENES);
    for (int t = 0; t < TERMS; t++) {
        assert_int_equal(lowered[t], SCENES);
        assert_int_equal(raised[t], SCENES);
    }
}

static bool has_mate(int entry)
{
    for (int i = 0; i < suite.entry_count; i++)
        if (i != entry && strcmp(suite.entry[i].scene, suite.entry[entry].scene) == 0 &&
            sb_variant_same_class(&suite.axes, &suite.entry[i].variant,
                                  &suite.entry[entry].variant))
            return true;
    return false;
}

static void classes_draws_every_implementation_and_none_alone(void **state)
{
    (void)state;
    load_shipped("classes.yaml");
    assert_in_range(suite.entry_count, 150, 240); // half a minute on two cores
    for (int i = 0; i < suite.entry_count; i++)
        if (!has_mate(i))
            fail_msg("%s is alone in its class", suite.entry[i].id);
    for (int a = 0; a < suite.axes.count; a++) {
        const struct sb_axis *axis = &suite.axes.row[a];
        for (int v = 0; axis->kind == SB_IMPLEMENTATION && v < axis->value_count; v++) {
            int count = 0;
            for (int i = 0; i < suite.entry_count; i++)
                count += suite.entry[i].variant.value[a] == v;
            if (count == 0 && !(axis->values[v].flags & SB_TODO))
                fail_msg("%s=%s is never drawn", axis->name, axis->values[v].name);
        }
    }
}

static void classes_has_every_axis_on_every_scene_that_is_lit_alike(void **state)
{
    (void)state;
    static const char *const scenes[] = {"containers", "tunnel", "blocks",
                                         "spheres",    "room",   "sphere"};
    load_shipped("classes.yaml");
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++)
        for (int a = SB_AXIS_LAYOUT; a <= SB_AXIS_GUARD; a++) {
            const double init = suite.axes.row[a].init;
            int varied = 0;
            for (int i = 0; i < suite.entry_count; i++)
                varied += strcmp(suite.entry[i].scene, scenes[s]) == 0 &&
                          suite.entry[i].variant.value[a] != init;
            if (varied == 0 && a != SB_AXIS_CAPACITY)
                fail_msg("%s is never varied on %s", suite.axes.row[a].name, scenes[s]);
        }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_suite)
    const struct CMUnitTest tests[] = {
        TEST(every_shipped_suite_expands_and_wastes_no_entry),
        TEST(lights_is_counts_by_type_by_stage),
        TEST(mix_is_always_eight_lights),
        TEST(softpipe_stays_small_enough_for_an_interpreter),
        TEST(precision_lowers_each_term_alone),
        TEST(terms_lowers_and_raises_each_term_alone),
        TEST(classes_draws_every_implementation_and_none_alone),
        TEST(classes_has_every_axis_on_every_scene_that_is_lit_alike),
    };
    return run_tests(tests);
}
