// From the platform axes of a plan to the driver it runs on: one process has one driver, so
// all entries must agree on them.
#pragma once

#include "job/job.h"
#include "suite/suite.h"

// Fills context and API of *params and sets the environment variables that the driver and thread
// axes and params->program_cache stand for (they must be set before a driver is loaded; what the
// user has set stays). SB_BAD_INPUT where two entries differ.
bool sb_platform_apply(const struct sb_suite *suite, struct sb_context_params *params,
                       struct sb_error *err);

// The first platform axis on which two plans differ, so that no driver can draw both; NULL: none. As
// among the variants of a plan, the GLSL version may differ.
const char *sb_platform_differs(const struct sb_suite *a, const struct sb_suite *b);

// Writes what was found back into the variant, so that results name the context, not "auto".
void sb_platform_record(const struct sb_caps *caps, struct sb_variant *variant);

// What a variant asks of precision, term by term, in the order of the axes.
enum { SB_PRECISION_TERMS = 10 };
struct sb_asked_precision {
    bool vertex_stage; // that lights
    int lowest;        // 0 highp, 1 mediump, 2 lowp: that any term asks for
    enum sb_emulation {
        SB_EMULATED_NOT,
        SB_EMULATED_FP16,   // mediump and lowp are binary16
        SB_EMULATED_FIXED10 // and lowp is 10-bit fixed point
    } emulation;
    struct sb_asked_term {
        const char *name; // of the axis: "p_vector"
        int precision;    // that it asks for …
        int declared; // … and that stands in the program: GLSL ES 1.00 has no qualifier for
                      // the output, which is mediump there (7.2)
        bool vertex_stage;       // where the term is probed: in this stage …
        enum sb_carrier carrier; // … and on this carrier
    } term[SB_PRECISION_TERMS];
};
struct sb_asked_precision sb_platform_precision(const struct sb_variant *variant);

// Does the program start its sum from a variable that nothing has set? One of the texts does.
bool sb_platform_undefined(const struct sb_variant *variant);

// Must variants of one equivalence class draw the same picture? At highp, with every
// f_… robust and offset=0 they must; elsewhere rounding may take them apart.
bool sb_platform_class_exact(const struct sb_variant *variant);

// Must these two of one class? Where the class must, unless textures are filtered and only one of
// them has its origin at the eye: what is interpolated then differs in its last bits, and a
// driver's filter takes steps (8 bits of weight on llvmpipe).
bool sb_platform_pair_exact(const struct sb_variant *a, const struct sb_variant *b);

// The most that lights which a policy leaves out of its programs change in a channel of a pixel, full
// scale 1: the axis `threshold` with specialise=scene and object, else 0.
double sb_platform_left_out(const struct sb_variant *variant);

// Are the programs of both chosen without looking at the scene (specialise=asked)?
bool sb_platform_pair_asked(const struct sb_variant *a, const struct sb_variant *b);

// Is an effect left out on purpose (axis `without`), so that lights may well change nothing?
bool sb_platform_leaves_out(const struct sb_variant *variant);

// Is the time of `variant` held against that of `other`, of the same scene? Of a policy against a
// program for all scenes that draws the same; of a variant that leaves an effect out on purpose
// against itself with nothing left out.
bool sb_platform_held_against(const struct sb_axes *axes, const struct sb_variant *other,
                              const struct sb_variant *variant);

// Are its programs chosen by a policy, and nothing left out on purpose?
bool sb_platform_is_policy(const struct sb_variant *variant);
