// Runs glslangValidator: the reference compiler, so a shader that it takes and a driver does
// not is the driver's matter.
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "assemble/assemble.h"
#include "base/file.h"
#include "base/process.h"

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

// `good`: the compiler ended with 0. What it said goes to `output`.
static bool run(const char *const *words, bool *good, struct sb_text *output,
                struct sb_error *err)
{
    const struct sb_process_params params = {
        .words = words, .output = SB_STREAM_TAKEN, .text = output};
    int exit_code = -1;
    const bool ended = sb_process_run(&params, &exit_code, err);
    if (!ended && err->status == SB_USAGE)
        sb_fail(err, SB_USAGE, "%s; validating shaders needs it (Debian: glslang-tools)",
                err->text);
    *good = ended && exit_code == 0;
    return ended;
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
    const char *words[2 + STAGES + 1] = {"glslangValidator", "-l"};
    int count = 2;
    for (int i = 0; i < STAGES; i++) {
        if (!source[i].text)
            continue;
        if (!sb_file_replace(folder->file[i], source[i].text, strlen(source[i].text),
                             err))
            return false;
        words[count++] = folder->file[i];
    }
    struct sb_text output = {0};
    bool good = false;
    if (run(words, &good, &output, err) && !good)
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
