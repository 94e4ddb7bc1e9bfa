// Correct before fast: what is checked of a picture before its time means anything.
#pragma once

#include "measure/task.h"

// The pixels that the scene covers: some, finite, not all black. Fails the task otherwise.
void sb_check_picture(struct sb_task *task, const struct sb_driver *driver);

// Every light changes a pixel of a small float picture of the task's own program: they are
// switched on one after another, so one that does nothing is found and named. For ten seconds
// at most; what was left unchecked is noted. `thorough`: all lights; else the last of each type,
// which finds a count that is off by one.
//
// Lights that are constants of the program cannot be switched off. They are those of a twin
// whose lights can, which is prepared for this and released again: it must draw the same
// picture, and its lights are checked.
void sb_check_lights(struct sb_task *task, const struct sb_prepare_params *params,
                     bool thorough);

// Linear light, full scale 1. Variants of an equivalence class may add the same numbers in
// another order: a sum of 768 lights then differs by some 768 x 2^-24.
#define SB_CLASS_BOUND 1e-4

struct sb_class_pair { // pictures, of one shape, of two variants of a class
    const char *id, *other_id;
    const struct sb_image *picture, *other;
    bool exact;      // sb_platform_pair_exact: they must agree
    double left_out; // what lights that a policy leaves out of either may change
};
// *spread is raised to the largest difference (NAN: there was none yet). SB_CLASS_BROKEN, with
// both variants, the pixel and both values, where an exact pair differs by more than the bound and
// what is left out.
bool sb_check_pair(const struct sb_class_pair *pair, double *spread,
                   struct sb_error *err);

// The small picture, or where a policy has chosen the programs of either the whole one, against that
// of a task of the same equivalence class: within the bound at
// highp, with every f_… robust and offset=0; elsewhere the difference is only kept, in class_spread.
void sb_check_class(struct sb_task *task, struct sb_task *other,
                    const struct sb_driver *driver);

// Marks programs with equal binaries: a difference in their times is none of the code.
void sb_check_same_code(struct sb_task *tasks, int count);
