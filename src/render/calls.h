// Counts GL calls where they are made, so that the number cannot drift from the code: for
// functions with an `int64_t *calls`.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define GL(call) (++*calls, (call))

struct sb_binding;

// All state of a picture but target and viewport (frame.c).
void sb_frame_state(bool gles, int64_t *calls);
// The program of a binding, its block of lights and its maps.
void sb_frame_bind(const struct sb_binding *binding, int64_t *calls);
// What differs between the draws: number `number` of the scene, its vertex array bound.
void sb_frame_place(const struct sb_binding *binding, int number, int64_t *calls);
