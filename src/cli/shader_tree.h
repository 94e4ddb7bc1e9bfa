// A shader folder, or what it was in a git revision.
#pragma once

#include "base/error.h"
#include "base/mem.h"

// `word` is a folder; else a revision of the git repository that `of` lies in, whose state of that
// folder then is put into dir/NAME. The folder's path, in `arena`; NULL and SB_BAD_INPUT where it is
// neither.
const char *sb_shader_tree(const char *word, const char *of, const char *dir,
                           const char *name, struct sb_arena *arena,
                           struct sb_error *err);

// The commit that the git repository stands at in which the folder `of` lies; NULL and SB_USAGE where
// it lies in none, or is not what that commit has.
const char *sb_shader_commit(const char *of, struct sb_arena *arena,
                             struct sb_error *err);
