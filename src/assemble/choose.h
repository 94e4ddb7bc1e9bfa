// Which programs a variant's policy (axis `specialise`) makes, and what each of them lights.
#pragma once

#include "assemble/assemble.h"
#include "effects/calls.h"

// One program to be: what it is compiled for, and the draws that it lights.
struct sb_choice_program {
    struct sb_calls calls; // of uber: raised to all that the suite calls for
    const int *draw;       // of the scene; NULL: all that show no lamp
    int draw_count;
};

struct sb_choice {
    struct sb_choice_program *program; // at least one
    int program_count;
    bool whole; // one program, all draws, all lights: nothing was looked up or left out
    bool switched; // asks with each draw: effects.def, and shaders/casters/counted.glsl
    struct sb_job_uniform *uniform; // what it asks
    int uniform_count;
    struct sb_scene scene;
    struct sb_analysis analysis; // owns the lists of lights
    struct sb_arena arena;       // owns the rest
};

// Programs may be equal: two draws that call for the same. SB_BAD_INPUT where the policy and
// another axis contradict each other. *choice must be zeroed; free also after failure.
bool sb_choose(const struct sb_assemble_params *params, struct sb_choice *choice,
               struct sb_error *err);
void sb_choice_free(struct sb_choice *choice);

// What a shader includes under this name: the uniforms that IF_… of a program for all scenes asks.
#define SB_SWITCHES_FILE "generated/switches.glsl"
void sb_switches_text(uint32_t effects, struct sb_text *text);
