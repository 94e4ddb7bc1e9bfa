#include "test.h"

#include "math/random.h"

static void splitmix64_gives_the_published_numbers(void **state)
{
    (void)state;
    // Vigna's splitmix64.c with the seed 1234567.
    const struct sb_random r = sb_random_seed(1234567);
    assert_true(r.state[0] == UINT64_C(6457827717110365317));
    assert_true(r.state[1] == UINT64_C(3203168211198807973));
    assert_true(r.state[2] == UINT64_C(9817491932198370423));
    assert_true(r.state[3] == UINT64_C(4593380528125082431));
}

static void xoshiro256_gives_the_published_numbers(void **state)
{
    (void)state;
    // Blackman and Vigna's xoshiro256starstar.c, started at 1, 2, 3, 4.
    static const uint64_t expected[] = {
        UINT64_C(11520),
        UINT64_C(0),
        UINT64_C(1509978240),
        UINT64_C(1215971899390074240),
        UINT64_C(1216172134540287360),
        UINT64_C(607988272756665600),
        UINT64_C(16172922978634559625),
        UINT64_C(8476171486693032832),
        UINT64_C(10595114339597558777),
        UINT64_C(2904607092377533576),
    };
    struct sb_random r = {{1, 2, 3, 4}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_true(sb_random_u64(&r) == expected[i]);
}

static void equal_seeds_give_equal_numbers_and_others_do_not(void **state)
{
    (void)state;
    struct sb_random a = sb_random_seed(0), b = sb_random_seed(0), c = sb_random_seed(1);
    int same = 0;
    for (int i = 0; i < 100; i++) {
        const uint64_t x = sb_random_u64(&a);
        assert_true(x == sb_random_u64(&b));
        same += x == sb_random_u64(&c);
    }
    assert_int_equal(same, 0);
}

static void below_favours_no_number_where_a_plain_remainder_would(void **state)
{
    (void)state;
    // 2^64 = 3 * 2^62 + 2^62: a plain remainder falls below 2^62 half of the time, not a
    // third of it.
    const uint64_t n = UINT64_C(3) << 62;
    const int draws = 30000;
    int count[3] = {0};
    struct sb_random r = sb_random_seed(7);
    for (int i = 0; i < draws; i++) {
        const uint64_t x = sb_random_below(&r, n);
        assert_true(x < n);
        count[x >> 62]++;
    }
    // Five standard deviations of a binomial share of 1/3.
    for (int i = 0; i < 3; i++)
        check_close(count[i], draws / 3.0, 5 * sqrt(draws * 2.0 / 9));
}

static void below_reaches_every_small_number_and_never_n(void **state)
{
    (void)state;
    struct sb_random r = sb_random_seed(3);
    for (uint64_t n = 1; n <= 8; n++) {
        unsigned seen = 0;
        for (int i = 0; i < 400; i++) {
            const uint64_t x = sb_random_below(&r, n);
            assert_true(x < n);
            seen |= 1u << x;
        }
        assert_int_equal(seen, (1u << n) - 1);
    }
}

static void unit_is_below_one_and_even(void **state)
{
    (void)state;
    struct sb_random r = sb_random_seed(11);
    const int draws = 100000;
    double sum = 0, squares = 0;
    for (int i = 0; i < draws; i++) {
        const double x = sb_random_unit(&r);
        assert_true(x >= 0 && x < 1);
        sum += x;
        squares += x * x;
    }
    check_close(sum / draws, 1.0 / 2, 5 / sqrt(12.0 * draws));
    check_close(squares / draws, 1.0 / 3, 5 * sqrt(4.0 / 45 / draws));

    // The state whose next output has all bits set: (2^64 - 1) / 9, rotated back, / 5,
    // both divisions modulo 2^64.
    struct sb_random top = {{1, UINT64_C(0x4fc71c71c71c71c7), 1, 1}};
    assert_true(sb_random_unit(&top) == 1 - 0x1p-53);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splitmix64_gives_the_published_numbers),
        cmocka_unit_test(xoshiro256_gives_the_published_numbers),
        cmocka_unit_test(equal_seeds_give_equal_numbers_and_others_do_not),
        cmocka_unit_test(below_favours_no_number_where_a_plain_remainder_would),
        cmocka_unit_test(below_reaches_every_small_number_and_never_n),
        cmocka_unit_test(unit_is_below_one_and_even),
    };
    return run_tests(tests);
}
