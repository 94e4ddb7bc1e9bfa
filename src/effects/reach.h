// How much a light can add to a draw.
#pragma once

#include "effects/bounds.h"

struct sb_reach_params {
    const struct sb_variant *variant; // laws, model and forms
    enum sb_light_type type;
    const struct sb_light *light; // world space
    const struct sb_bounds *bounds;
    const struct sb_material *material;
};

enum sb_reach_why {
    SB_REACH_LIT,
    SB_REACH_OFF,          // intensity 0, or every colour black
    SB_REACH_ABSORBED,     // the material reflects none of it
    SB_REACH_OUT_OF_RANGE, // every point of the draw is beyond it
    SB_REACH_OUT_OF_CONE
};

struct sb_reach {
    double
        bound; // the most that it adds to any channel of a pixel, full scale 1; INFINITY: no bound
    double diffuse, specular, ambient; // of it, each alone
    double distance; // least, from the light (an area light's nearest point) to the draw
    enum sb_reach_why why; // LIT, or why the bound is 0
};

// Conservative, by every law (docs/effects.md has the bounds). Distances are taken 1 % shorter and
// cones 1 degree wider than they are, and both by what rounding does to positions, so that no precision
// of a shader finds light beyond. Naive
// forms of attenuation and cone bound nothing.
void sb_reach_of(const struct sb_reach_params *params, struct sb_reach *reach);

// Factor of the fall-off at a distance, at most; INFINITY where the form has no bound.
double sb_reach_factor(const struct sb_variant *variant, const struct sb_light *light,
                       double distance);

// The distance from which on the factor is below `factor`, by bisection; INFINITY: never.
double sb_reach_distance(const struct sb_variant *variant, const struct sb_light *light,
                         double factor);
