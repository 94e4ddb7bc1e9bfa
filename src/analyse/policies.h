// What the policies of making programs (one for all scenes, one a scene, one an object) save.
#pragma once

#include "results/row.h"

// Compiling, linking, and what the first draw takes longer than any other, in ms. NAN: not known.
double sb_row_setup_ms(const struct sb_row *row);

// Frames after which `saved_ms` a frame has paid for `longer_ms` of set-up; 0: it takes no longer;
// INFINITY: no frame is faster. NAN where the set-up is cheaper and frames are dearer.
double sb_payback_frames(double longer_ms, double saved_ms);

// The row that another one is held against (`against`, of the same scene), or NULL.
const struct sb_row *sb_row_against(const struct sb_row *rows, int count,
                                    const struct sb_row *row);

// One policy over all scenes of a run, each shown for as many frames.
struct sb_policy_total {
    const struct sb_row *first; // whose implementation axes all have
    int rows, programs;         // of all scenes together
    double setup_ms,
        uber_setup_ms; // of all its programs; of those that it is held against, equal
                       // ones made once
    double ratio;      // frame time over the other's, geometric mean over scenes
    double saved_ms;   // a frame, mean over scenes
    double payback_frames;
};

// Rows of `row` that are held against another and for which `is_policy` says so, by their
// implementation axes, in order. Fills total[0 …], which has room for `count`, and returns how many.
int sb_policy_totals(const struct sb_axes *axes, const struct sb_row *row, int count,
                     bool (*is_policy)(const struct sb_variant *variant),
                     struct sb_policy_total *total);
