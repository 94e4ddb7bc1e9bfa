// The precision of a row in words: what its terms ask for, and what that comes to.
#pragma once

#include "assemble/platform.h"
#include "base/mem.h"
#include "measure/driver.h"

// "mediump" where all terms ask for the same; else the highest of them and those that differ:
// "highp but p_vector mediump, p_color lowp".
const char *sb_precision_requested(const struct sb_asked_precision *asked,
                                   struct sb_arena *arena);

// What the driver was proven to make of them: "fp16", "fp32", "fp32 (mediump ignored)", or the
// most common and those that differ: "fp16 but p_uniform fp32, p_output fp32". "other": neither of
// the two formats, or a mixture. With emulation: "fp16 emulated", "fp16 emulated, lowp fixed10
// emulated"; where some terms are highp, term by term. NULL where nothing was probed.
const char *sb_precision_effective(const struct sb_asked_precision *asked,
                                   const struct sb_driver *driver,
                                   struct sb_arena *arena);
