// Readings for the timer audit and the precision probe: synthetic loads of our own, drawn
// in the current context. Nothing is judged here. Both change GL state (program, targets,
// vertex array, tests) and leave no object behind.
#pragma once

#include "gl/gl.h"
#include "stats/audit.h"

// Overwrites *audit: every row of sb_timers, in order, with its readings. A query that
// never became available is read as -1 ns. Takes about two seconds; up to ten where
// waiting for the driver is dear.
bool sb_gl_audit_read(const struct sb_caps *caps, struct sb_audit *audit,
                      struct sb_error *err);

// Overwrites *probe: all of sb_precision_questions, but for the output where there are no float
// targets.
bool sb_gl_probe_precision(const struct sb_caps *caps, struct sb_probe *probe,
                           struct sb_error *err);

// The deepest of 64, 32, … nested conditionals that compile and draw right.
bool sb_gl_probe_nesting(const struct sb_caps *caps, int *nesting, struct sb_error *err);
