#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/log.h"
#include "base/words.h"
#include "cli/common.h"
#include "cli/write.h"

static bool is_stdout(const struct sb_output *output)
{
    return strcmp(output->path, "-") == 0;
}

static bool fail_form(const char *word, struct sb_error *err)
{
    enum { ROOM = 64 };
    const char *names[ROOM];
    int count = 0;
    for (; count < sb_export_format_count && count < ROOM; count++)
        names[count] = sb_export_formats[count].name;
    const char *nearest = sb_nearest_word(word, names, count);
    return sb_fail(err, SB_USAGE,
                   "--write %s: FORMAT=FILE in one word is wanted, such as --write "
                   "%s=FILE (shadebench list formats)",
                   word, nearest ? nearest : names[0]);
}

bool sb_outputs_add(struct sb_outputs *outputs, const char *word, struct sb_error *err)
{
    char name[64];
    const char *equals = strchr(word, '=');
    if (!equals || !equals[1]) {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
        return fail_form(name, err);
    }
    if (outputs->count == SB_OUTPUTS_MAX)
        return sb_fail(err, SB_USAGE, "--write: more than %d of them", SB_OUTPUTS_MAX);
    snprintf(name, sizeof name, "%.*s", (int)(equals - word), word);
    const struct sb_export_format *format = sb_export_format_find("--write", name, err);
    if (!format)
        return false;
    outputs->item[outputs->count++] =
        (struct sb_output){.word = word, .format = format, .path = equals + 1};
    return true;
}

bool sb_outputs_take_stdout(const struct sb_outputs *outputs)
{
    for (int i = 0; i < outputs->count; i++)
        if (is_stdout(&outputs->item[i]))
            return true;
    return false;
}

// The results folder, and what is in it, may be made by the command itself.
static bool is_within(const char *folder, const char *parent)
{
    size_t length = parent ? strlen(parent) : 0;
    while (length > 1 && parent[length - 1] == '/')
        length--;
    return length && strncmp(folder, parent, length) == 0 &&
           (folder[length] == '/' || folder[length] == '\0');
}

// Whether FILE can be written, as far as that can be known before there is anything to write.
static bool check_place(const struct sb_output *output, const char *results,
                        struct sb_error *err)
{
    struct stat info;
    struct sb_arena arena = {0};
    const char *slash = strrchr(output->path, '/');
    const char *folder =
        !slash ? "."
        : slash == output->path
            ? "/"
            : sb_arena_printf(&arena, "%.*s", (int)(slash - output->path), output->path);
    const bool there = stat(output->path, &info) == 0;
    bool good = true;
    if (there && S_ISDIR(info.st_mode))
        good =
            sb_fail(err, SB_USAGE, "--write %s: is a folder; give a file", output->word);
    else if (there && !S_ISREG(info.st_mode)) // written into, not replaced
        good = access(output->path, W_OK) == 0 ||
               sb_fail(err, SB_USAGE, "--write %s: %s", output->word, strerror(errno));
    else if (!is_within(folder, results) && !sb_dir_exists(folder))
        good = sb_fail(err, SB_USAGE, "--write %s: there is no folder %s", output->word,
                       folder);
    else if (sb_dir_exists(folder) && access(folder, W_OK | X_OK) != 0)
        good = sb_fail(err, SB_USAGE, "--write %s: nothing can be written in %s: %s",
                       output->word, folder, strerror(errno));
    sb_arena_free(&arena);
    return good;
}

bool sb_outputs_check(const struct sb_options *options, struct sb_error *err)
{
    const char *results = options->output ? options->output : options->resume;
    const char *taken = options->json ? "--json" : NULL;
    for (int i = 0; i < options->write.count; i++) {
        const struct sb_output *output = &options->write.item[i];
        if (!is_stdout(output)) {
            if (!check_place(output, results, err))
                return false;
            continue;
        }
        if (taken)
            return sb_fail(err, SB_USAGE,
                           "--write %s: standard output is taken by %s; give a file",
                           output->word, taken);
        taken = output->format->name;
    }
    return true;
}

static bool write_stdout(const struct sb_export *export,
                         const struct sb_export_format *format, struct sb_error *err)
{
    struct sb_text text = {0};
    format->write(export, &text);
    errno = 0;
    const bool good =
        fwrite(text.data, 1, text.length, stdout) == text.length && fflush(stdout) == 0;
    sb_text_free(&text);
    return good || sb_fail(err, SB_WRITE_FAILED, "standard output: %s", strerror(errno));
}

int sb_outputs_write(const struct sb_outputs *outputs, const struct sb_export *export)
{
    int code = 0;
    for (int i = 0; i < outputs->count; i++) {
        const struct sb_output *output = &outputs->item[i];
        struct sb_error err = {0};
        const bool good = is_stdout(output) ? write_stdout(export, output->format, &err)
                                            : sb_export_write(export, output->format,
                                                              output->path, &err);
        if (!good)
            code = sb_exit_code_worse(code, sb_cli_fail(&err));
    }
    return code;
}
