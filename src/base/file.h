// Files: reading with a limit, replacing whole files safely, and finding our own data.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "base/mem.h"

// The file's bytes with a NUL behind them, in `arena`; *size may be NULL. A file over
// `limit` bytes, a directory or an unreadable file is SB_BAD_INPUT with the path.
char *sb_file_read(struct sb_arena *arena, const char *path, size_t limit, size_t *size,
                   struct sb_error *err);

// Replaces `path` by way of a temporary file beside it and rename(2): a reader, or a disk
// that fills up, sees the old content or the new one, never half. SB_WRITE_FAILED.
bool sb_file_replace(const char *path, const char *data, size_t size,
                     struct sb_error *err);
// The same of a file that other processes may replace at the same time: the last one's is left,
// whole, and none of them fails for it. The temporary file has the process's number in its name.
bool sb_file_replace_shared(const char *path, const char *data, size_t size,
                            struct sb_error *err);

bool sb_file_exists(const char *path);
bool sb_dir_exists(const char *path);
bool sb_dir_make(const char *path, struct sb_error *err); // with parents, like mkdir -p

// Regular files of a folder whose name ends in `suffix`, sorted; *count of them.
char **sb_dir_list(struct sb_arena *arena, const char *path, const char *suffix,
                   int *count, struct sb_error *err);

// A new folder of this process's own, in $TMPDIR or /tmp; its name starts with `prefix`.
char *sb_temporary_dir(struct sb_arena *arena, const char *prefix, struct sb_error *err);
// Removes a folder and the files in it, as far as it can; not the folders in it.
void sb_dir_remove(const char *path);

// Is there a program of that name in $PATH?
bool sb_in_path(const char *program);

char *sb_path_join(struct sb_arena *arena, const char *folder, const char *name);

// Where shaders/ and bench/ lie: `given` (--data) if not NULL, else $SHADEBENCH_DATA, else
// ../share/shadebench seen from the executable.
char *sb_data_dir(struct sb_arena *arena, const char *given, struct sb_error *err);

// This program's own path, for starting it again.
char *sb_executable(struct sb_arena *arena, struct sb_error *err);
