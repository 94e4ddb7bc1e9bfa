// Over the density of triangles: where one value of a quality axis becomes faster than another,
// as lighting per fragment does from so many triangles a pixel on. Pairs of rows that differ in
// that axis alone, at two or more densities that differ in nothing else.
//
// Triangles a pixel: vertices / 3 / fragments, of summary.csv. Between densities the logarithm
// of the ratio is taken as straight over the logarithm of the density; nothing is said outside.
#pragma once

#include "base/mem.h"
#include "results/row.h"

struct sb_crossing_pair {
    double density; // triangles a pixel
    const struct sb_row *a, *b;
    double ratio, lo,
        hi; // time of a over that of b, with all quotients of their intervals
};

struct sb_crossing {
    double density; // where the two take equally long
    double lo,
        hi; // where the intervals of the ratio begin and cease to hold 1, around it
    bool open_lo, open_hi; // they still do at the least, at the largest density measured
    bool b_first;          // b is faster below, a above; else the other way round
};

struct sb_crossing_series {
    int axis, value_a, value_b;    // b later in the axis's list
    struct sb_crossing_pair *pair; // ascending in density; two or more
    int pairs;
    struct sb_crossing *crossing;
    int crossings;
};

struct sb_crossings {
    struct sb_crossing_series *series; // in the order of the axis table, then of the rows
    int count;
    struct sb_arena arena;
};

// Over all choice axes of quality, and as densities all axes flagged SB_TRUTH. Rows are borrowed;
// *crossings must be zeroed.
void sb_crossings_find(const struct sb_axes *axes, const struct sb_row *row, int count,
                       struct sb_crossings *crossings);
void sb_crossings_free(struct sb_crossings *crossings);
