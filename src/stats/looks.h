// When to look at the intervals, and when to stop. Whoever looks after every round and
// stops at the first narrow interval stops too early too often: so looks are few, known
// beforehand, and share the allowed error between them (Bonferroni).
#pragma once

#include <stdbool.h>

#include "stats/order.h"

// Looks after `first`, 2 first, 4 first ... rounds, and after the last of `rounds`. The
// end of a run counts as a look whatever ends it: if the time runs out between two looks,
// the interval given then stands in for the looks that no longer happen.
struct sb_looks {
    int first, rounds; // at least 1
};

// How many looks there are, at least 1.
int sb_look_count(const struct sb_looks *looks);

// The level of the interval at each look, 1 - 0.05 / sb_look_count(): all of them
// together hold with at least 95 %.
double sb_look_level(const struct sb_looks *looks);

// Is there a look after this many rounds?
bool sb_look_due(const struct sb_looks *looks, int rounds);

// Is the interval's half-width at most this share of its point? Never without bounds.
bool sb_precise_enough(const struct sb_interval *interval, double precision);
