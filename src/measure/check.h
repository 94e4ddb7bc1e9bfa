// Correct before fast: what is checked of a picture before its time means anything.
#pragma once

#include "measure/task.h"

// The colour image: finite, not blank, covering something. Fails the task where it is not.
void sb_check_picture(struct sb_task *task, const struct sb_driver *driver);

// Every light changes a pixel of a small float picture of the task's own program. Groups that
// make a difference are halved until single lights remain, so a light that does nothing is
// found and named. `thorough`: all lights; else the last of each type, which finds a count
// that is off by one.
void sb_check_lights(struct sb_task *task, const struct sb_driver *driver, bool thorough);

// Marks programs with equal binaries: a difference in their times is none of the code.
void sb_check_same_code(struct sb_task *tasks, int count);
