// A suite cut short or with bytes changed is loaded or refused, never a crash, a leak or
// an empty message (run it under AddressSanitizer).
#include "test.h"

#include "suite_text.h"

static const char whole[] =
    "suite: damaged\n"
    "about: >-\n  two lines\n  of text\n"
    "scene: [containers, 'sphere']\n"
    "target: 64x32 rgba16f\n"
    "base: {stage: vertex, p_sum: mediump}\n"
    "sweep:\n  point: &counts [0, 1..8 x2, \"12\"]\n  spot: *counts\n  curve: linear, "
    "cubic\n"
    "cross: {precision: [highp, mixed], taps: 1..4 step 3}\n"
    "exclude:\n  - point=1,spot!=2 | taps>=4,curve=linear\n"
    "measure: {budget: 1.5, seed: 7}\n"
    "axes:\n"
    "  - name: curve\n    kind: quality\n    define: CURVE\n"
    "    values: [linear, {name: cubic, text: c3}]\n"
    "  - {name: taps, kind: scene, define: TAPS, min: 0, max: 9, init: 2, whole: true,\n"
    "     when: curve=cubic | point>2}\n"
    "expect:\n"
    "  - where: {point: [1, 8..12], scene: sphere}\n    max_err: \"<= 2/255\"\n"
    "  - {nonfinite: 0, status: ok}\n";
enum { SIZE = sizeof whole - 1 };

static void try_bytes(const char *bytes, size_t size)
{
    if (load_bytes(bytes, size, (struct sb_suite_params){0})) {
        assert_true(suite.entry_count > 0);
        return;
    }
    assert_int_not_equal(err.status, SB_OK);
    assert_int_not_equal(err.status, SB_INTERNAL);
    assert_true(strlen(err.text) > 0);
}

static void the_whole_suite_loads(void **state)
{
    (void)state;
    must_load(whole);
    assert_int_equal(suite.axes.count, SB_AXIS_BUILTIN_COUNT + 2);
}

static void every_beginning_of_it_is_survived(void **state)
{
    (void)state;
    for (size_t size = 0; size < SIZE; size++)
        try_bytes(whole, size);
}

static uint32_t state_of_random = 20221207;

static uint32_t next_random(uint32_t below)
{
    // Numerical Recipes' generator; the high bits are the good ones.
    state_of_random = state_of_random * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)state_of_random * below >> 32);
}

static void changed_bytes_are_survived(void **state)
{
    (void)state;
    static const char likely[] = "{}[]:,-&*|>\"'# \n\t0129.x=!\\%@";
    for (int round = 0; round < 1500; round++) {
        char bytes[SIZE];
        memcpy(bytes, whole, SIZE);
        const uint32_t changes = 1 + next_random(4);
        for (uint32_t i = 0; i < changes; i++) {
            const uint32_t at = next_random(SIZE);
            if (next_random(3) == 0)
                bytes[at] = (char)(bytes[at] ^ (1 << next_random(8)));
            else
                bytes[at] = likely[next_random(sizeof likely - 1)];
        }
        try_bytes(bytes, SIZE);
    }
}

static void lines_that_change_places_are_survived(void **state)
{
    (void)state;
    for (int round = 0; round < 300; round++) {
        const size_t from = next_random(SIZE), length = 1 + next_random(60);
        const size_t to = next_random(SIZE);
        char bytes[SIZE + 64];
        const size_t taken = from + length > SIZE ? SIZE - from : length;
        memcpy(bytes, whole, to);
        memcpy(bytes + to, whole + from, taken);
        memcpy(bytes + to + taken, whole + to, SIZE - to);
        try_bytes(bytes, SIZE + taken);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_teardown(name, free_suite)
    const struct CMUnitTest tests[] = {
        TEST(the_whole_suite_loads),
        TEST(every_beginning_of_it_is_survived),
        TEST(changed_bytes_are_survived),
        TEST(lines_that_change_places_are_survived),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
