// The rows of a results folder, for the commands that measure nothing.
#pragma once

#include "cli/common.h"
#include "results/rows.h"

struct sb_compared {
    const char *path;      // of summary.csv
    const char *folder;    // that it lies in
    struct sb_suite suite; // the folder's copy; empty without one
    const struct sb_axes *axes;
    struct sb_rows rows;
};

// `word` is a results folder or its summary.csv. Of a run that did not end one line is said, with what
// it lacks and how to go on. *compared must be zeroed; free also after
// failure. The paths live in the arena.
bool sb_results_load(const struct sb_options *options, const char *word,
                     struct sb_compared *compared, struct sb_arena *arena,
                     struct sb_error *err);
// How far a run has come, from its run.json.
struct sb_run_progress {
    int started, complete, wanted; // processes
    bool stopped;                  // the last of them
};
struct sb_run_progress sb_run_progress(const json_t *run);
bool sb_run_is_whole(const json_t *run);

// The folder to go on with: `folder`, or where it holds one platform of a run over several, the one
// that holds all of them.
const char *sb_results_whole(const char *folder, struct sb_arena *arena);

// One line where `folder` has a gate that did not end.
void sb_results_warn_gate(const char *folder);
void sb_results_free(struct sb_compared *compared);
