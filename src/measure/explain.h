// One pixel, with everything that was computed on the way to its colour: in double from the
// inputs that the driver had, and by the driver's own program.
#pragma once

#include "measure/truths.h"

// --- the terms of a light ----------------------------------------------------------------

enum sb_term {
#define TERM(name, components, place, axes, help) SB_TERM_##name,
    SB_REF_TERMS(TERM)
#undef TERM
        SB_TERM_COUNT
};
struct sb_term_row {
    const char *name, *axes, *help; // axes: whose precision it has
    int components;
    int place;     // of the first in SB_PROBE_LIGHT
    size_t offset; // in struct sb_ref_terms
    double floor; // an error is told in units in the last place of max(|value|, floor) …
    double wrong; // … and of more than so many the term went wrong
};
extern const struct sb_term_row sb_term_rows[SB_TERM_COUNT];

// |value - reference| in units in the last place of max(|reference|, floor) in a format of so
// many significant bits (24: binary32, 11: binary16) and smallest normal exponent; infinity
// where only one of them is finite.
double sb_ulps(double value, double reference, double floor, int bits);

// Significant bits of the least precise format that these axes ("p_vector p_color"; NULL: all) come
// to: 24, or 11 where one of them is proven, or emulated, to be less than binary32.
int sb_effective_bits(const struct sb_task *task, const struct sb_driver *driver,
                      const char *axes);

struct sb_explained_light {
    enum sb_light_type type;
    int number;            // of its type
    struct sb_light light; // as it was uploaded
    const struct sb_ref_terms *reference;
    float driver[12];           // SB_PROBE_LIGHT
    double ulps[SB_TERM_COUNT]; // the largest of the components
    int wrong;                  // the first term that went wrong; -1: none
};

// Where the lighting is evaluated: the fragment itself, or one vertex of its triangle.
struct sb_explained_point {
    int vertex; // of its mesh; -1: the fragment
    struct sb_ref_point reference;
    float inputs[12],
        frame[12]; // SB_PROBE_INPUTS, SB_PROBE_FRAME; per vertex `inputs` without
                   // the colours
    float diffuse[3], specular[3]; // per vertex: what it hands on
    struct sb_explained_light *light;
};

struct sb_explanation {
    int x, y, width, height;
    int draw, triangle;        // draw -1: the background; a lamp: nothing else is set
    double weight[3];          // exact, at the pixel's centre
    float driver_weight[3];    // the driver's own
    struct sb_ref_input exact; // interpolated by the exact weights, world space
    const struct sb_material *material;
    int light_count;
    int bits
        [SB_TERM_COUNT]; // significant ones of the precision that a term was computed in
    int point_count;     // 1, or 3 vertices
    struct sb_explained_point point[3];
    bool has_maps;  // the variant reads any
    float maps[12]; // then SB_PROBE_MAPS of the pixel, wherever it is lit
    double ideal[3], model[3], given[3];
    float wide[4], own[4]; // as floats, and in the target's format
    // Largest difference of the colour that the instrumented program draws there from `wide`; where
    // it is not 0, what a driver is said to have is that other program's.
    double probe_off;
    int wrong_point, wrong_light, wrong_term; // the first that went wrong; -1: none
    struct sb_truth truth;
    struct sb_arena arena;
};

// SB_BAD_INPUT where the pixel is outside, or the program has no probe (GLSL ES 1.00).
// *explanation must be zeroed; free also after failure. It refers to what `truths` keeps, until the next sb_truths_get.
struct sb_explain_params {
    const struct sb_task *task; // prepared, with a probe
    const struct sb_driver *driver;
    struct sb_truths *truths;
    int x, y;          // pixel, from the lower left …
    int width, height; // … of a picture of this size; 0: the task's own
    int light_max;     // lights that are looked at; 0: all
};
bool sb_explain(const struct sb_explain_params *params,
                struct sb_explanation *explanation, struct sb_error *err);
void sb_explanation_free(struct sb_explanation *explanation);
