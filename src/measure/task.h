// A task: one plan entry on its way from a variant to a row. Every stage of a run fills its
// own part: prepare, check, calibrate, rounds; summary.c makes the row of it.
#pragma once

#include "assemble/assemble.h"
#include "assemble/frozen.h"
#include "image/metrics.h"
#include "measure/driver.h"
#include "measure/split.h"
#include "results/row.h"
#include "suite/suite.h"

struct sb_accuracy { // of a picture against the reference
    bool known;
    struct sb_metrics total;
    struct sb_flip flip;
    struct sb_split split; // `counted` is NULL
    const char
        *term; // the first that went wrong at the largest arithmetic error; NULL: none
};

struct sb_task {
    const struct sb_plan_entry *entry;
    // prepare
    struct sb_assembly assembly;
    struct sb_prepared prepared;
    bool decided; // the assembly's variant is the entry's, with what was decided of it
    bool loaded;  // the runner holds the job
    bool untimed; // a value of an axis is for accuracy only
    // any stage
    enum sb_status status;
    struct sb_text note; // clauses joined by "; "
    // check
    int64_t nonfinite, negative; // SB_NO_COUNT until checked
    double
        class_spread; // largest difference to the class; NAN: alone in it, or unchecked
    struct sb_accuracy accuracy;
    // calibrate
    int batch;            // frames a batch
    double growth;        // time over that of a quarter of the pixels; 0: not known
    double shadow_share;  // of a frame, that its shadow maps take; NAN: it draws none
    double payback_check; // of a policy against the uber program; NAN: not asked
    // rounds
    bool active;                  // still measured in this process
    const char *stop;             // half_width, budget, rounds, interrupted
    struct sb_sample_row *sample; // of all processes, in order of measuring
    int sample_count, sample_capacity;
};

// Appends a clause to the note.
void sb_task_note(struct sb_task *task, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// The first failure stays: sets status, appends the text to the note, and takes the task out
// of the measuring.
void sb_task_fail(struct sb_task *task, const struct sb_error *err);

// "SCENE-ID", for a file or folder of the task's own; an id that is too long for that, or
// holds more than letters, digits and "-_.,=+", goes on as a hash.
char *sb_task_file_name(const struct sb_task *task, struct sb_arena *arena);

// Is there anything left to measure? False once a check failed.
bool sb_task_sound(const struct sb_task *task);

// Sound, and to be timed: emulated precision is for accuracy only, and never is.
bool sb_task_timed(const struct sb_task *task);

// The light `index` of the task's whole list, as "point light 3".
void sb_task_light_name(const struct sb_task *task, int index, struct sb_text *text);
int sb_task_light_count(const struct sb_task *task);

void sb_task_add_sample(struct sb_task *task, const struct sb_sample_row *row);

// Releases the job and everything owned.
void sb_task_free(struct sb_task *task, const struct sb_driver *driver);

struct sb_prepare_params {
    const struct sb_suite *suite;
    const struct sb_driver *driver;
    const char *data_dir, *shaders;
    bool movable_lights;            // of sb_assemble_params
    bool renamed;                   // sb_assembly_rename
    const struct sb_frozen *frozen; // not assembled, but these texts; NULL: none
};

// Assembles and prepares: afterwards the task is loaded, or its status says why not.
void sb_task_prepare(struct sb_task *task, const struct sb_prepare_params *params,
                     uint32_t id);
