// run.json: everything needed to repeat a run, and to judge its numbers.
#pragma once

#include <jansson.h>

#include "measure/task.h"

struct sb_record_params {
    const struct sb_suite *suite;
    const struct sb_driver *driver;
    const struct sb_task *task;
    int task_count;
    const json_t *arguments;   // of the command line, as an array; borrowed
    int process;               // this one
    const char *started;       // when this one began, UTC
    bool complete;             // this one measured all that it set out to
    const char *program_cache; // its folder; NULL: none
};

// Extends the run.json of earlier processes (NULL: none). New reference.
json_t *sb_record_make(const struct sb_record_params *params, const json_t *earlier);

json_t *sb_settings_json(const struct sb_measure_settings *settings);
json_t *sb_caps_json(const struct sb_caps *caps);
json_t *sb_audit_json(const struct sb_driver *driver);
json_t *sb_precision_json(const struct sb_driver *driver);
