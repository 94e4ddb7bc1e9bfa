#include <math.h>

#include "stats/looks.h"

int sb_look_count(const struct sb_looks *looks)
{
    int count = 1; // the last round
    for (long at = looks->first; at < looks->rounds; at *= 2)
        count++;
    return count;
}

double sb_look_level(const struct sb_looks *looks)
{
    return 1 - 0.05 / sb_look_count(looks);
}

bool sb_look_due(const struct sb_looks *looks, int rounds)
{
    long at = looks->first;
    while (at < rounds)
        at *= 2;
    return rounds == at || rounds == looks->rounds;
}

bool sb_precise_enough(const struct sb_interval *interval, double precision)
{
    return (interval->hi - interval->lo) / 2 <= precision * fabs(interval->point);
}
