// `run --images`: every variant as a PNG, the shadow maps of its casters, and one contact
// sheet of the whole run.
#pragma once

#include "measure/task.h"

struct sb_pictures_params {
    const struct sb_task *task; // those that are loaded are drawn
    int task_count;
    const struct sb_driver *driver;
    const char *dir; // results folder; the files go to dir/images
};

// SCENE-ID.png, SCENE-ID-shadow0.png …, sheet.png and its legend, sheet.txt.
bool sb_pictures_write(const struct sb_pictures_params *params, struct sb_error *err);
