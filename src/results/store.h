// A results folder: samples.csv (appended after every round), summary.csv and run.json
// (replaced whole). Whatever was measured is on disk before the next round begins.
#pragma once

#include <jansson.h>

#include "results/row.h"

struct sb_store; // opaque

struct sb_store_params {
    const char *dir;
    const struct sb_axes *axes;
    bool append; // go on with what is there; else the folder must hold no results yet
};

// SB_BAD_INPUT where the folder cannot be made or written, or holds results already.
struct sb_store *sb_store_open(const struct sb_store_params *params,
                               struct sb_error *err);
void sb_store_close(struct sb_store **store);

// SB_WRITE_FAILED names the file and the cause; what was written before stays whole.
bool sb_store_samples(struct sb_store *store, const struct sb_sample_row *rows, int count,
                      struct sb_error *err);
bool sb_store_summary(struct sb_store *store, const struct sb_row *rows, int count,
                      struct sb_error *err);
bool sb_store_run(struct sb_store *store, const json_t *run, struct sb_error *err);

// The same of a folder that has no samples of its own: of a run over several platforms.
bool sb_store_run_in(const char *dir, const json_t *run, struct sb_error *err);

// Reads a folder's run.json; the caller decrefs. NULL on failure.
json_t *sb_store_read_run(const char *dir, struct sb_error *err);
