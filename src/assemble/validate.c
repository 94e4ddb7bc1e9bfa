// Runs glslangValidator: the reference compiler, so a shader that it takes and a driver does
// not is the driver's matter.
#include <errno.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assemble/assemble.h"
#include "base/file.h"

extern char **environ;

// Files, not standard input: only files can be linked with each other, and no pipe can fill
// up or break. The compiler tells the stage by these suffixes.
static const char *const file_names[] = {"program.vert", "program.geom", "program.frag"};
enum { STAGES = sizeof file_names / sizeof *file_names };

struct folder {
    char *path, *file[STAGES];
    struct sb_arena arena;
};

static bool folder_make(struct folder *folder, struct sb_error *err)
{
    const char *parent = getenv("TMPDIR");
    folder->path = sb_path_join(&folder->arena, parent && *parent ? parent : "/tmp",
                                "shadebench-XXXXXX");
    if (!mkdtemp(folder->path)) {
        sb_fail(err, SB_WRITE_FAILED, "%s: %s", folder->path, strerror(errno));
        folder->path = NULL;
        return false;
    }
    for (int i = 0; i < STAGES; i++)
        folder->file[i] = sb_path_join(&folder->arena, folder->path, file_names[i]);
    return true;
}

static void folder_remove(struct folder *folder)
{
    if (folder->path) {
        for (int i = 0; i < STAGES; i++)
            unlink(folder->file[i]);
        rmdir(folder->path);
    }
    sb_arena_free(&folder->arena);
}

static bool read_all(int fd, struct sb_text *output)
{
    char buffer[4096];
    for (;;) {
        const ssize_t got = read(fd, buffer, sizeof buffer);
        if (got > 0)
            sb_text_add_n(output, buffer, (size_t)got);
        else if (got == 0)
            return true;
        else if (errno != EINTR)
            return false;
    }
}

static bool wait_for(pid_t child, int *status)
{
    while (waitpid(child, status, 0) < 0)
        if (errno != EINTR)
            return false;
    return true;
}

// `good`: the compiler ended with 0. What it said on stdout goes to `output`.
static bool run(char *const *argv, bool *good, struct sb_text *output,
                struct sb_error *err)
{
    int ends[2];
    if (pipe(ends) != 0)
        return sb_fail(err, SB_INTERNAL, "pipe: %s", strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    pid_t child;
    const int cause = posix_spawnp(&child, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (cause != 0) {
        close(ends[0]);
        return sb_fail(err, SB_USAGE,
                       "%s: %s; validating shaders needs it (Debian: glslang-tools)",
                       argv[0], strerror(cause));
    }
    int status;
    const bool read_good = read_all(ends[0], output);
    close(ends[0]);
    if (!wait_for(child, &status) || !read_good)
        return sb_fail(err, SB_INTERNAL, "%s: %s", argv[0], strerror(errno));
    *good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return true;
}

// "ERROR: /tmp/…/program.vert:12: text" -> the original file and line. The compiler's own form
// for a string without a name, "ERROR: 0:12:", is what sb_glsl_explain knows.
static bool explain_message(const char *message, const char *path,
                            const struct sb_glsl_source *source, struct sb_text *text)
{
    static const char word[] = "ERROR: ";
    const size_t head = strlen(word), length = strlen(path);
    if (strncmp(message + head, path, length) != 0 || message[head + length] != ':')
        return false;
    const char *rest = message + head + length;
    struct sb_text plain = {0};
    sb_text_printf(&plain, "%s0", word);
    sb_text_add_n(&plain, rest, strcspn(rest, "\n"));
    sb_glsl_explain(source, sb_text_get(&plain), text);
    sb_text_free(&plain);
    return true;
}

static bool fail_compile(const struct sb_glsl_source source[STAGES],
                         const struct folder *folder, const char *output,
                         struct sb_error *err)
{
    const char *message = strstr(output, "ERROR: ");
    if (!message)
        return sb_fail(err, SB_COMPILE_FAILED, "glslangValidator failed and said: %s",
                       output);
    struct sb_text text = {0};
    bool explained = false;
    for (int i = 0; i < STAGES && !explained; i++)
        explained = source[i].text &&
                    explain_message(message, folder->file[i], &source[i], &text);
    if (!explained) // of linking: stages on several lines
        sb_text_add(&text, message);
    sb_fail(err, SB_COMPILE_FAILED, "%s", sb_text_get(&text));
    sb_text_free(&text);
    return false;
}

static bool validate_program(const struct sb_glsl_source source[STAGES],
                             const struct folder *folder, struct sb_error *err)
{
    char *argv[2 + STAGES + 1] = {"glslangValidator", "-l"};
    int count = 2;
    for (int i = 0; i < STAGES; i++) {
        if (!source[i].text)
            continue;
        if (!sb_file_replace(folder->file[i], source[i].text, strlen(source[i].text),
                             err))
            return false;
        argv[count++] = folder->file[i];
    }
    struct sb_text output = {0};
    bool good = false;
    if (run(argv, &good, &output, err) && !good)
        fail_compile(source, folder, sb_text_get(&output), err);
    sb_text_free(&output);
    return good;
}

bool sb_assembly_validate(const struct sb_assembly *assembly, struct sb_error *err)
{
    struct folder folder = {0};
    bool good = folder_make(&folder, err);
    for (int i = 0; good && i < assembly->built_count; i++)
        good = validate_program(assembly->built[i].source, &folder, err);
    folder_remove(&folder);
    return good;
}
