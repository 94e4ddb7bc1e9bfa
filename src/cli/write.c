#include <errno.h>
#include <stdio.h>
#include <string.h>

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

bool sb_outputs_check(const struct sb_options *options, struct sb_error *err)
{
    const char *taken = options->json ? "--json" : NULL;
    for (int i = 0; i < options->write.count; i++) {
        const struct sb_output *output = &options->write.item[i];
        if (!is_stdout(output))
            continue;
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
