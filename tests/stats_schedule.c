#include "test.h"

#include "stats/schedule.h"

enum { MOST = 12 };

static void each_variant_stands_once_in_each_position_of_a_block(void **state)
{
    (void)state;
    for (int count = 1; count <= MOST; count++)
        for (int block = 0; block < 5; block++) {
            int stood[MOST][MOST] = {{0}};
            for (int step = 0; step < count; step++) {
                int order[MOST], in_round[MOST] = {0};
                sb_schedule_order(42, count, block * count + step, order);
                for (int i = 0; i < count; i++) {
                    assert_in_range(order[i], 0, count - 1);
                    in_round[order[i]]++;
                    stood[order[i]][i]++;
                }
                for (int v = 0; v < count; v++)
                    assert_int_equal(in_round[v], 1);
            }
            for (int v = 0; v < count; v++)
                for (int i = 0; i < count; i++)
                    assert_int_equal(stood[v][i], 1);
        }
}

static void a_round_is_rotated_by_one_step_from_the_one_before(void **state)
{
    (void)state;
    int before[7], after[7];
    for (int step = 0; step < 6; step++) {
        sb_schedule_order(9, 7, 14 + step, before);
        sb_schedule_order(9, 7, 15 + step, after);
        for (int i = 0; i < 7; i++)
            assert_int_equal(after[i], before[(i + 1) % 7]);
    }
}

static void two_variants_run_abba_or_baab(void **state)
{
    (void)state;
    int first_of_block[2] = {0};
    for (int round = 0; round < 200; round += 2) {
        int order[2], next[2];
        sb_schedule_order(1, 2, round, order);
        sb_schedule_order(1, 2, round + 1, next);
        assert_int_equal(order[1], 1 - order[0]);
        assert_int_equal(next[0], order[1]);
        assert_int_equal(next[1], order[0]);
        first_of_block[order[0]]++;
    }
    assert_in_range(first_of_block[0], 30, 70);
}

static void one_variant_runs_alone(void **state)
{
    (void)state;
    int order = -1;
    sb_schedule_order(1, 1, 12345, &order);
    assert_int_equal(order, 0);
}

static void order_depends_on_seed_and_block_and_on_nothing_else(void **state)
{
    (void)state;
    int first[MOST], again[MOST], elsewhere[MOST];
    int same_seed = 0, same_block = 0, shifted = 0;
    for (int block = 0; block < 50; block++) {
        sb_schedule_order(7, MOST, block * MOST, first);
        sb_schedule_order(8, MOST, 3, elsewhere);
        sb_schedule_order(7, MOST, block * MOST, again);
        assert_memory_equal(first, again, sizeof first);
        sb_schedule_order(8, MOST, block * MOST, elsewhere);
        same_seed += memcmp(first, elsewhere, sizeof first) == 0;
        sb_schedule_order(7, MOST, (block + 1) * MOST, elsewhere);
        same_block += memcmp(first, elsewhere, sizeof first) == 0;
        sb_schedule_order(6, MOST, (block + 1) * MOST, elsewhere);
        shifted += memcmp(first, elsewhere, sizeof first) == 0;
    }
    assert_int_equal(same_seed + same_block + shifted, 0);
}

static void permutations_of_blocks_are_uniform(void **state)
{
    (void)state;
    int found[27] = {0};
    for (int block = 0; block < 6000; block++) {
        int order[3];
        sb_schedule_order(5, 3, block * 3, order);
        found[order[0] * 9 + order[1] * 3 + order[2]]++;
    }
    int kinds = 0;
    for (int i = 0; i < 27; i++)
        if (found[i]) {
            kinds++;
            assert_in_range(found[i], 850, 1150); // 1000, give or take five deviations
        }
    assert_int_equal(kinds, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_variant_stands_once_in_each_position_of_a_block),
        cmocka_unit_test(a_round_is_rotated_by_one_step_from_the_one_before),
        cmocka_unit_test(two_variants_run_abba_or_baab),
        cmocka_unit_test(one_variant_runs_alone),
        cmocka_unit_test(order_depends_on_seed_and_block_and_on_nothing_else),
        cmocka_unit_test(permutations_of_blocks_are_uniform),
    };
    return run_tests(tests);
}
