// From the platform axes of a plan to the driver it runs on: one process has one driver, so
// all entries must agree on them.
#pragma once

#include "job/job.h"
#include "suite/suite.h"

// Fills *params and sets the environment variables that the driver and thread axes stand for
// (they must be set before a driver is loaded; what the user has set stays). SB_BAD_INPUT
// where two entries differ.
bool sb_platform_apply(const struct sb_suite *suite, struct sb_context_params *params,
                       struct sb_error *err);

// Writes what was found back into the variant, so that results name the context, not "auto".
void sb_platform_record(const struct sb_caps *caps, struct sb_variant *variant);

// The stage that lights, the lowest precision that any term of it asks for (0 highp, 1
// mediump, 2 lowp), and whether all terms ask for the same.
struct sb_asked_precision {
    bool vertex_stage, uniform;
    int lowest;
};
struct sb_asked_precision sb_platform_precision(const struct sb_variant *variant);

// Does the program start its sum from a variable that nothing has set? One of the texts does.
bool sb_platform_undefined(const struct sb_variant *variant);

// Must variants of one equivalence class draw the same picture? At highp, form=robust and
// offset=0 they must; elsewhere rounding may take them apart.
bool sb_platform_class_exact(const struct sb_variant *variant);
