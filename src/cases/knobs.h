// What of a point and its lights can be turned, for the search: a table of their members with the
// ranges that are tried.
#pragma once

#include "cases/points.h"
#include "math/random.h"

struct sb_knob {
    const char *name; // as C writes it: "position", "light->constant"
    bool of_light;
    size_t offset;    // in struct sb_point or struct sb_light
    int components;   // each is turned by itself
    double low, high; // of the magnitude, which is tried log-uniformly
    bool sign, zero;  // may it be negative; is 0 tried too?
};
extern const struct sb_knob sb_knobs[];
extern const int sb_knob_count;

// The float that component `c` of a knob turns, of a point and its first light.
float *sb_knob_of(const struct sb_points *points, int point, const struct sb_knob *knob,
                  int c);
// A random value for it.
double sb_knob_draw(const struct sb_knob *knob, struct sb_random *random);
// A value near `value`: within a few powers of two, or a few units in the last place.
double sb_knob_turn(const struct sb_knob *knob, double value, struct sb_random *random);
// What follows from others (the cone from its angles), and what must hold among them (the inner
// angle is not the wider one; not all of an attenuation is 0; a spot light points somewhere).
void sb_knobs_settle(struct sb_points *points, int point);
