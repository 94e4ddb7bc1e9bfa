#include "cli/results.h"

#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "measure/run.h"

// The suite's copy is wanted for the axes that it declares; built-in ones are known without it.
static void load_axes(const struct sb_options *options, const char *folder,
                      struct sb_compared *compared, struct sb_arena *arena)
{
    struct sb_error err = {0};
    const char *path = sb_path_join(arena, folder, SB_SUITE_COPY);
    compared->axes = sb_axes_builtin();
    if (!sb_file_exists(path))
        return;
    const struct sb_suite_params params = {
        .path = path,
        .data_dir = sb_data_dir(arena, options->data, &err),
    };
    if (sb_suite_load(&params, &compared->suite, &err))
        compared->axes = &compared->suite.axes;
    else
        sb_warn("%s; only built-in axes are known", err.text);
}

bool sb_results_load(const struct sb_options *options, const char *word,
                     struct sb_compared *compared, struct sb_arena *arena,
                     struct sb_error *err)
{
    const char *folder = word;
    if (sb_dir_exists(word)) {
        compared->path = sb_path_join(arena, word, "summary.csv");
        if (!sb_file_exists(compared->path))
            return sb_fail(err, SB_BAD_INPUT,
                           "%s: the folder has no summary.csv; a results folder of "
                           "shadebench run is wanted",
                           word);
    } else if (sb_file_exists(word)) {
        char *copy = sb_arena_strdup(arena, word);
        char *slash = strrchr(copy, '/');
        if (slash)
            slash[slash == copy] = '\0';
        folder = slash ? copy : ".";
        compared->path = word;
    } else {
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: there is no such folder or file; a results folder or its "
                       "summary.csv is wanted",
                       word);
    }
    compared->folder = folder;
    load_axes(options, folder, compared, arena);
    return sb_rows_read(compared->path, compared->axes, &compared->rows, err);
}

void sb_results_free(struct sb_compared *compared)
{
    sb_rows_free(&compared->rows);
    sb_suite_free(&compared->suite);
}
