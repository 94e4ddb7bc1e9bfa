// What the files of `gate` share.
#pragma once

#include <jansson.h>

#include "cli/common.h"
#include "export/export.h"
#include "gate/gate.h"

struct sb_gate_lost { // hard cases that base passes and head does not
    struct sb_gate_lost_case {
        const char *cell; // "dist-overflow16 fragment fp16"
        const char *says;
    } * it;
    int count, capacity;
    bool unknown; // those of base could not be verified
    struct sb_arena arena;
};

struct sb_gate_shown {
    const struct sb_options *options;
    const struct sb_gate_result *result;
    const struct sb_suite *suite; // head's
    const char *dir;
    const char *base, *head;         // what the sides are, in words
    bool pinned;                     // the driver's threads were, by us
    const struct sb_gate_lost *lost; // NULL: hard cases were not asked
};

void sb_gate_print(const struct sb_gate_shown *shown); // tables, to stdout
json_t *sb_gate_json(const struct sb_gate_shown *shown);

// For other programs; texts and numbers live in `arena` and in the result.
void sb_gate_export(const struct sb_gate_shown *shown, struct sb_arena *arena,
                    struct sb_export *export);

// `list`, of --cases: "all", or cases and families with commas between; NULL: none. SB_USAGE.
bool sb_gate_cases_check(const char *list, struct sb_error *err);
// Verifies them with both shader folders, and tells of each cell that base passes and head does
// not. Where base's cannot be verified none is lost, and lost->unknown. *lost must be zeroed; free
// also after failure. SB_INTERRUPTED where a signal came.
bool sb_gate_cases(const struct sb_gate_params *params, const char *list,
                   struct sb_gate_lost *lost, struct sb_error *err);
void sb_gate_lost_free(struct sb_gate_lost *lost);

// Was head sound, and base alone could not be drawn or timed?
bool sb_gate_base_failed(const struct sb_gate_row *row);
