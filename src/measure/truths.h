// Pictures of the reference, kept for the variants that share them.
#pragma once

#include "measure/task.h"
#include "reference/render.h"

struct sb_truths; // opaque
struct sb_truths *sb_truths_new(const struct sb_axes *axes);
void sb_truths_free(struct sb_truths **truths);

struct sb_truth { // all of it stays the cache's, until the next sb_truths_get
    const struct sb_scene *scene;
    const struct sb_ref_ground *ground;
    const struct sb_ref_picture *ideal, *model;
};
// For a task that is prepared, at a size in pixels.
bool sb_truths_get(struct sb_truths *truths, const struct sb_task *task, int width,
                   int height, struct sb_truth *truth, struct sb_error *err);

// Pictures that were computed so far, for tests: no two tasks that share one count twice.
int sb_truths_rendered(const struct sb_truths *truths);
