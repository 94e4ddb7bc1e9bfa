// A triangle made ready to be filled, for the files that fill it.
#pragma once

#include "reference/geometry_state.h"

struct sb_ref_setup {
    struct sb_ref_cover name;
    const struct sb_ref_clip *corner[3];
    int x0, x1, y0, y1; // pixels it may cover, inclusive; none where y1 < y0
    double det;
    int facing;       // its sign, never 0 where there are pixels
    bool cut;         // by the near or the far plane
    double low, high; // of a triangle that is not: z/w lies between these
};
void sb_ref_setup_make(const struct sb_ref_geometry *geometry, struct sb_ref_cover name,
                       struct sb_ref_setup *setup);
