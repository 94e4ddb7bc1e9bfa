// A run: a plan on one driver, from opened context to results folder. One call is one process;
// more processes, and runs that were interrupted, append to the same folder.
#pragma once

#include <jansson.h>

#include "measure/driver.h"
#include "results/row.h"
#include "suite/suite.h"

#define SB_SUITE_COPY "suite.yaml" // name of the suite's copy in a results folder

struct sb_run_params {
    struct sb_suite *suite;
    struct sb_driver_params driver;
    // One that was examined before, and is used instead: a process has one context. It stays open.
    const struct sb_driver *examined; // NULL: the run opens its own
    const char *data_dir, *shaders;
    const char *dir;         // results folder
    bool append;             // go on with what the folder holds
    bool images;             // write a PNG of each variant
    bool payback;            // fill payback_check
    const char *dump;        // folder for sb_dump of each variant; NULL: none
    const char *suite_file;  // copied beside the results, for --resume; NULL: none
    const json_t *arguments; // of the command line, for run.json; borrowed
};

struct sb_run_result {
    struct sb_row *row; // one a plan entry
    int row_count;
    int processes_done; // complete ones in the folder, this one included
    bool interrupted;
    int exit_code;              // the worst of the rows; 130 when interrupted
    struct sb_run_state *state; // keeps what the rows point to
};

// False when nothing could be run, or the results could not be written; in the latter case
// the rows are there all the same. *result must be zeroed; free also after failure.
bool sb_run(const struct sb_run_params *params, struct sb_run_result *result,
            struct sb_error *err);
void sb_run_result_free(struct sb_run_result *result);

// Leaves a copy of the suite in the results folder `dir`. SB_BAD_INPUT, SB_WRITE_FAILED
bool sb_run_copy_suite(const char *suite_file, const char *dir, struct sb_error *err);
