// `run --images`: every variant as a PNG, its error as a heat map, the shadow maps of its casters,
// and contact sheets of the whole run.
#pragma once

#include "measure/truths.h"

struct sb_pictures_params {
    const struct sb_task *task; // those that are loaded are drawn
    int task_count;
    const struct sb_driver *driver;
    struct sb_truths *truths;
    const char *dir; // results folder; the files go to dir/images
};

// SCENE-ID.png, SCENE-ID-error.png, SCENE-ID-shadow0.png …, sheet.png, sheet-error.png and their
// legend, sheet.txt.
bool sb_pictures_write(const struct sb_pictures_params *params, struct sb_error *err);
