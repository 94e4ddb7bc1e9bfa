// The anchor of a history: a program of which nothing changes, so that what others cost relative to
// it can be told over commits. data_dir/bench/anchor has its variant and scene, and its final texts
// in a folder for each API.
#pragma once

#include "assemble/frozen.h"
#include "suite/suite.h"

struct sb_anchor {
    struct sb_suite suite; // one entry
    struct sb_frozen text;
    uint64_t hash; // of the files
    struct sb_arena arena;
};

// `like`: a suite whose platform the anchor is to run on. *anchor must be zeroed; free also after
// failure.
bool sb_anchor_load(const char *data_dir, const struct sb_suite *like, bool gles,
                    struct sb_anchor *anchor, struct sb_error *err);
void sb_anchor_free(struct sb_anchor *anchor);

// What rows of a history are marked with: the files, and the scene as it was uploaded (`input_hash`
// of sb_prepared), whose change changes the cost too.
uint64_t sb_anchor_mark(const struct sb_anchor *anchor, uint64_t input_hash);
