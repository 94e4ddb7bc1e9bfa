// What a draw needs: the answers of the analysis before they are put in the language of axes.
#pragma once

#include "effects/calls.h"

struct sb_needs {
    bool *lit; // of each light of the scene's whole list
    bool ambient, diffuse, specular;
    unsigned maps;          // bit i: map i
    bool falls_off;         // some factor is not 1
    bool linear, quadratic; // terms of the polynomial
    bool cone, fresnel, renormalise;
    int casters; // the first so many point lights have their shadows looked up
};

// Of the axis `maps`, bit i for map i, and back.
unsigned sb_maps_asked(const struct sb_variant *variant);
int sb_maps_value(unsigned maps);

// Nothing but what `without` (axis of the variant) leaves of them.
void sb_needs_leave_out(struct sb_needs *needs, const struct sb_variant *variant,
                        const struct sb_lights *lights);

// As calls; lists live in the arena.
void sb_needs_to_calls(const struct sb_needs *needs, const struct sb_axes *axes,
                       const struct sb_variant *variant, const struct sb_lights *lights,
                       struct sb_arena *arena, struct sb_calls *calls);
