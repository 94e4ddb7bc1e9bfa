#include "job/callgrind.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/text.h"

#define DUMP_LIMIT ((size_t)64 << 20)

char *sb_shell_quote(struct sb_arena *arena, const char *word)
{
    struct sb_text quoted = {0};
    sb_text_add(&quoted, "'");
    for (const char *p = word; *p; p++) // ' becomes '\''
        sb_text_add_n(&quoted, *p == '\'' ? "'\\''" : p, *p == '\'' ? 4 : 1);
    sb_text_add(&quoted, "'");
    char *copy = sb_arena_strdup(arena, quoted.data);
    sb_text_free(&quoted);
    return copy;
}

// --instr-atstart=no: a compiler runs some ten times faster while nothing is counted.
// --vgdb=no: no pipes in /tmp.
char *sb_callgrind_command(struct sb_arena *arena, const char *folder)
{
    const char *pattern = sb_path_join(arena, folder, "count.%p");
    return sb_arena_printf(arena,
                           "valgrind --tool=callgrind -q --vgdb=no --instr-atstart=no "
                           "--callgrind-out-file=%s",
                           sb_shell_quote(arena, pattern));
}

// The value of the last line "key: value".
static const char *find_line(const char *text, const char *key)
{
    const char *found = NULL;
    const size_t length = strlen(key);
    for (const char *line = text; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, key, length) == 0)
            found = line + length + strspn(line + length, " ");
    }
    return found;
}

bool sb_callgrind_total(const char *text, int64_t *instructions)
{
    const char *events = find_line(text, "events:"), *total = find_line(text, "totals:");
    char *end;
    if (!events || strncmp(events, "Ir", 2) != 0 || !strchr(" \n", events[2]) || !total)
        return false;
    errno = 0;
    const long long count = strtoll(total, &end, 10);
    if (end == total || !*end || !strchr(" \n", *end) || errno != 0 || count < 0)
        return false;
    *instructions = count;
    return true;
}

bool sb_callgrind_take(const char *folder, int pid, int64_t *instructions,
                       struct sb_error *err)
{
    struct sb_arena arena = {0};
    int count = 0;
    bool good = false;
    // "count.PID" is what it writes as it ends, "count.PID.1" and so on what it is asked for.
    const char *prefix = sb_arena_printf(&arena, "count.%d.", pid);
    char **name = sb_dir_list(&arena, folder, "", &count, err);
    const char *path = NULL;
    for (int i = 0; name && i < count; i++)
        if (strncmp(name[i], prefix, strlen(prefix)) == 0)
            path = sb_path_join(&arena, folder, name[i]);
    const char *text = path ? sb_file_read(&arena, path, DUMP_LIMIT, NULL, err) : NULL;
    if (name && !path)
        sb_fail(err, SB_INTERNAL,
                "callgrind left no file %s* in %s: was it started with "
                "--callgrind-out-file=%s/count.%%p?",
                prefix, folder, folder);
    else if (text && !(good = sb_callgrind_total(text, instructions)))
        sb_fail(err, SB_INTERNAL,
                "%s: is no whole file of callgrind that counts "
                "instructions (Ir)",
                path);
    if (path)
        unlink(path);
    sb_arena_free(&arena);
    return good;
}
