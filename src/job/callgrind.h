// callgrind, valgrind's counter of instructions: how a process is started under it, and what the
// files say that it leaves (valgrind's manual, "Callgrind Format Specification").
#pragma once

#include "base/error.h"
#include "base/mem.h"

#include <stdint.h>

// The start of a command for /bin/sh, whose next word is the program. Nothing is counted until
// the program asks for it. Its files go to `folder`.
char *sb_callgrind_command(struct sb_arena *arena, const char *folder);

// Quoted for /bin/sh: a word whatever is in it.
char *sb_shell_quote(struct sb_arena *arena, const char *word);

// Reads what process `pid` has left of the counts since its last file in `folder`, and removes
// the file. SB_INTERNAL where there is none, or it is not whole.
bool sb_callgrind_take(const char *folder, int pid, int64_t *instructions,
                       struct sb_error *err);

// Instructions ("Ir") of the whole of such a file's text. False: it is no such text, it counts
// something else, or its end, which has the total, is missing.
bool sb_callgrind_total(const char *text, int64_t *instructions);
