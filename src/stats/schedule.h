// The order in which a round runs its variants.
#pragma once

#include <stdint.h>

// Fills order[0 .. variant_count - 1] with the variants in the order of this round,
// counted from 0. Rounds come in blocks of variant_count: each block has a random
// permutation of its own, rotated by one step a round (a cyclic Latin square), so that
// within a block each variant stands once in each position; two variants run ABBA or
// BAAB. A pure function of its arguments: any round can be asked for alone.
void sb_schedule_order(uint64_t seed, int variant_count, int round, int *order);
