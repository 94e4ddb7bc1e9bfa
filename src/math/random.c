#include "math/random.h"

static uint64_t splitmix64(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

struct sb_random sb_random_seed(uint64_t seed)
{
    // Four different outputs of a bijection: at most one of them is zero.
    struct sb_random r;
    for (int i = 0; i < 4; i++)
        r.state[i] = splitmix64(&seed);
    return r;
}

static uint64_t rotate_left(uint64_t x, int bits)
{
    return x << bits | x >> (64 - bits);
}

uint64_t sb_random_u64(struct sb_random *r)
{
    uint64_t *s = r->state;
    uint64_t result = rotate_left(s[1] * 5, 7) * 9;
    uint64_t t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotate_left(s[3], 45);
    return result;
}

uint64_t sb_random_below(struct sb_random *r, uint64_t n)
{
    // The 2^64 mod n lowest draws are thrown away, so that every remainder is left with
    // equally many.
    uint64_t threshold = (0 - n) % n;
    for (;;) {
        uint64_t x = sb_random_u64(r);
        if (x >= threshold)
            return x % n;
    }
}

double sb_random_unit(struct sb_random *r)
{
    return (double)(sb_random_u64(r) >> 11) * 0x1p-53;
}
