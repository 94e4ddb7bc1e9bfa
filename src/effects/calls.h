// What the draws of a scene call for: the effects and lights that can change a pixel of each,
// in the language of axes. A specialised program is a variant with smaller counts, and a mask over
// the table of effects. No GL.
//
// Conservative: what might matter stays. Bounds are taken over the whole draw (its box and sphere in
// world space) and over all phases of lights that move; reach has 1 % to spare, so that no precision
// of the shaders finds light beyond it.
#pragma once

#include "base/text.h"
#include "effects/effects.h"
#include "scene/scene.h"

struct sb_calls { // what is compiled for one draw, or for several
    // As asked, but with smaller counts (dir, point, spot, area, shadows), fewer maps, model=lambert
    // where no highlight shows, ambient=none where there is none, attenuation=none where every
    // factor is 1; resolved.
    struct sb_variant variant;
    uint32_t
        effects; // sb_effects_of(variant), less what changes no pixel: bit i is effect i
    // Numbers in the scene's whole list, ascending, as many of each type as the variant's counts
    // say. The first variant.value[SB_AXIS_SHADOWS] points are those of the scene, so that the
    // number of a caster is the number of its map: casters up to the last that matters stay.
    const int *light;
    int light_count[SB_LIGHT_TYPE_COUNT];
};

// How many of its lights have their shadows looked up.
int sb_calls_casters(const struct sb_calls *calls);

// Why a light, or an effect, is left out of a draw.
struct sb_decision {
    int draw;
    int light;        // number in the whole list; -1: an effect
    const char *what; // "point light 7", "specular"; in the analysis' arena, as is …
    const char *why;  // "out of range: its light ends at 14.2"
};

struct sb_analysis {
    struct sb_calls
        *draw; // scene->draw_count; of a lamp's draw nothing is said (light_count 0)
    struct sb_calls scene; // the union over all lit draws
    int draw_count;
    struct sb_decision *decision;
    int decision_count, decision_capacity;
    struct sb_arena arena; // owns all of the above
};

struct sb_analysis_params {
    const struct sb_axes *axes;
    const struct sb_variant *variant; // resolved; threshold and without are its axes
    const struct sb_scene *scene;     // made for it
    bool explain;                     // fill `decision` too
};

// The lights left out of a draw together add at most `threshold` to any channel of a pixel; those
// that add nothing (off, black, out of range, outside the cone) are left out at any threshold.
// The effect that the axis `without` names is left out whatever it changes; of the scene's program
// and of every draw's alike. *analysis must be zeroed; sb_analysis_free in any case.
void sb_analyse(const struct sb_analysis_params *params, struct sb_analysis *analysis);
void sb_analysis_free(struct sb_analysis *analysis);

// What the variant asks for, with all lights, less the effect that the axis `without` names: what
// specialise=asked compiles. `light` is NULL: all of them.
void sb_calls_asked(const struct sb_axes *axes, const struct sb_variant *variant,
                    struct sb_calls *calls);
