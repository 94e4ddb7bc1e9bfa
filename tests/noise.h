// Noise for simulations.
#pragma once

#include <math.h>

#include "math/random.h"

// Normal, of mean 0 and deviation 1: Box and Muller, "A note on the generation of random normal
// deviates", Annals of Mathematical Statistics 29, 1958.
static inline double normal_noise(struct sb_random *random)
{
    const double u = 1 - sb_random_unit(random), v = sb_random_unit(random);
    return sqrt(-2 * log(u)) * cos(2 * 3.14159265358979323846 * v);
}

// A deviation of 1, and of 10 in one case of twenty: what a busy machine adds.
static inline double spiky_noise(struct sb_random *random)
{
    const double noise = normal_noise(random);
    return sb_random_below(random, 20) == 0 ? 10 * noise : noise;
}
