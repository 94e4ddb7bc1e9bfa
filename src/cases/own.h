// What cases share that do more than ask about points: the upload path, figures and tasks.
#pragma once

#include "cases/judge.h"
#include "measure/task.h"

// Takes one more figure of a case down: the first that fails stays, else the one that comes nearest
// to its bound. *outcome must be as sb_case_ask hands it to `run`.
void sb_outcome_measured(struct sb_outcome *outcome, enum sb_figure figure,
                         double measured, double bound);

// `run` of cases whose remedy is on the CPU. Naive: all of the case's points are lit, as if
// nobody looked at what is uploaded. Robust: sb_scene_validate looks at them, each by itself, and
// only those that it lets through are lit. SB_VERDICT_REFUSED where that is none; the note has
// what it says of the first.
bool sb_case_run_upload(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_outcome *outcome,
                        struct sb_error *err);

// A variant and a scene as a task that `run` could have, of a suite that has nothing but it. Free
// it also after failure.
struct sb_case_task {
    struct sb_suite suite;
    struct sb_plan_entry entry;
    struct sb_task task;
};
bool sb_case_task_open(const struct sb_case_env *env, const struct sb_variant *variant,
                       const char *scene, struct sb_case_task *one, struct sb_error *err);
void sb_case_task_free(const struct sb_case_env *env, struct sb_case_task *one);
