// Correct before fast: what is checked of a picture before its time means anything.
#pragma once

#include "measure/task.h"

// The pixels that the scene covers: some, finite, not all black. Fails the task otherwise.
void sb_check_picture(struct sb_task *task, const struct sb_driver *driver);

// Every light changes a pixel of a small float picture of the task's own program: they are
// switched on one after another, so one that does nothing is found and named. For ten seconds
// at most; what was left unchecked is noted. `thorough`: all lights; else the last of each type,
// which finds a count that is off by one.
void sb_check_lights(struct sb_task *task, const struct sb_driver *driver, bool thorough);

// The small picture against that of a task of the same equivalence class: equal, or within
// 1e-4 where the order of operations differs, at highp, form=robust and offset=0; elsewhere
// the difference is only kept, in class_spread.
void sb_check_class(struct sb_task *task, struct sb_task *other,
                    const struct sb_driver *driver);

// Marks programs with equal binaries: a difference in their times is none of the code.
void sb_check_same_code(struct sb_task *tasks, int count);
