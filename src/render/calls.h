// Counts GL calls where they are made, so that the number cannot drift from the code: for
// functions with an `int64_t *calls`.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define GL(call) (++*calls, (call))

// All state of a picture but target and viewport (frame.c).
void sb_frame_state(bool gles, int64_t *calls);
