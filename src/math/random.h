// Pseudo-random numbers that are the same on every machine: xoshiro256** seeded by
// splitmix64 (Blackman and Vigna, "Scrambled linear pseudorandom number generators", ACM
// TOMS 47(4), 2021). For shuffles and seeds; not for secrets.
#pragma once

#include <stdint.h>

struct sb_random {
    uint64_t state[4]; // not all zero; sb_random_seed sees to it
};

struct sb_random sb_random_seed(uint64_t seed);

// All 64 bits uniform.
uint64_t sb_random_u64(struct sb_random *r);

// Uniform in 0 .. n - 1, without bias; n > 0.
uint64_t sb_random_below(struct sb_random *r, uint64_t n);

// Uniform in [0, 1), a multiple of 2^-53.
double sb_random_unit(struct sb_random *r);
