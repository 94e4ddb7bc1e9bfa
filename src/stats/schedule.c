#include "math/random.h"
#include "stats/schedule.h"

void sb_schedule_order(uint64_t seed, int variant_count, int round, int *order)
{
    // Blocks count on from a random place: from the seed itself, block 1 of seed 7 would
    // be block 0 of seed 8.
    struct sb_random random = sb_random_seed(seed);
    random = sb_random_seed(sb_random_u64(&random) + (uint64_t)(round / variant_count));

    // Fisher and Yates' shuffle, over places that are counted from the rotated start.
    const int start = variant_count - round % variant_count;
    for (int i = 0; i < variant_count; i++)
        order[(start + i) % variant_count] = i;
    for (int i = variant_count - 1; i > 0; i--) {
        int *const here = &order[(start + i) % variant_count];
        int *const there =
            &order[(start + (int)sb_random_below(&random, (uint64_t)i + 1)) %
                   variant_count];
        const int variant = *here;
        *here = *there;
        *there = variant;
    }
}
