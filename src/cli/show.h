// The parts of `show`.
#pragma once

#include "cli/common.h"

// What the draws of each entry call for, in words or JSON.
bool sb_show_effects(const struct sb_options *options, const struct sb_suite *suite,
                     struct sb_error *err);
