// What a run has left, its rows and its results folder, as what the writers take.
#pragma once

#include <jansson.h>

#include "base/mem.h"
#include "export/export.h"
#include "results/row.h"

struct sb_export_source {
    const char *name; // "shadebench run lights"
    const struct sb_row *row;
    int row_count;
    const char *dir; // samples.csv and run.json are read from it; NULL: the rows are all
};

struct sb_exported {
    struct sb_export export;
    struct sb_arena arena;
};

// The rows are borrowed. False where a file of the folder cannot be read: then *exported has what
// there is without it. *exported must be zeroed; free also after failure.
bool sb_export_from_results(const struct sb_export_source *source,
                            struct sb_exported *exported, struct sb_error *err);
void sb_exported_free(struct sb_exported *exported);

// --- its parts, for who judges rows and fills in outcome, side and ratio ----------------------

// A row without its samples; texts are borrowed, counters live in `arena`.
void sb_export_row_from(const struct sb_row *row, struct sb_arena *arena,
                        struct sb_export_row *to);

// The samples of a folder to the rows of their scene and variant. Memory is the arena's.
bool sb_export_add_samples(const char *dir, struct sb_export_row *row, int count,
                           struct sb_arena *arena, struct sb_error *err);

// What is to be known of a run: driver, timer, machine, seed and date, from run.json (NULL: none) and
// the rows. Texts live in `arena` or are the rows'. At most SB_EXPORT_PROPERTIES; their number.
enum { SB_EXPORT_PROPERTIES = 16 };
int sb_export_properties_from(const json_t *run, const struct sb_row *row, int count,
                              struct sb_arena *arena,
                              struct sb_export_property properties[SB_EXPORT_PROPERTIES]);

// By the exit code of the status: done passed, what was checked and failed failed, what is not valid is
// an error, and what was not measured or is inconclusive is skipped.
enum sb_export_outcome sb_export_outcome_of(enum sb_status status);
