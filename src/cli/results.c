#include "cli/results.h"

#include <jansson.h>
#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "measure/run.h"
#include "results/store.h"

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

struct sb_run_progress sb_run_progress(const json_t *run)
{
    const json_t *processes = json_object_get(run, "processes"), *process;
    const json_t *measure = json_object_get(run, "measure");
    struct sb_run_progress progress = {
        .started = (int)json_array_size(processes),
        .wanted = (int)json_number_value(json_object_get(measure, "processes")),
    };
    size_t i;
    json_array_foreach(processes, i, process)
    {
        progress.stopped = !json_is_true(json_object_get(process, "complete"));
        progress.complete += !progress.stopped;
    }
    return progress;
}

bool sb_run_is_whole(const json_t *run)
{
    const struct sb_run_progress progress = sb_run_progress(run);
    return progress.complete > 0 && !progress.stopped &&
           progress.complete >= progress.wanted;
}

const char *sb_results_whole(const char *folder, struct sb_arena *arena)
{
    struct sb_error ignored;
    char *parent = sb_arena_strdup(arena, folder);
    size_t length = strlen(parent), i;
    while (length > 1 && parent[length - 1] == '/')
        parent[--length] = '\0';
    char *slash = strrchr(parent, '/');
    const char *name = slash ? slash + 1 : parent, *whole = folder;
    const char *above = !slash ? "." : slash == parent ? "/" : parent;
    if (slash)
        *slash = '\0';
    if (!sb_file_exists(sb_path_join(arena, above, "run.json")))
        return folder;
    json_t *run = sb_store_read_run(above, &ignored);
    const json_t *platform;
    json_array_foreach(json_object_get(run, "platforms"), i, platform)
    {
        const char *label = json_string_value(json_object_get(platform, "platform"));
        if (label && strcmp(label, name) == 0)
            whole = above;
    }
    json_decref(run);
    return whole;
}

static void warn_platforms(const char *folder, const json_t *platforms)
{
    int whole = 0;
    size_t i;
    const json_t *platform;
    json_array_foreach(platforms, i, platform) whole +=
        json_is_true(json_object_get(platform, "complete"));
    if (whole < (int)json_array_size(platforms))
        sb_warn("%s: the run is incomplete: %d of its %d platforms were measured to the "
                "end; go on with: shadebench run --resume %s",
                folder, whole, (int)json_array_size(platforms), folder);
}

// What is missing of a run, from its record.
static void warn_incomplete(const char *folder, struct sb_arena *arena)
{
    struct sb_error ignored;
    if (!sb_file_exists(sb_path_join(arena, folder, "run.json")))
        return;
    json_t *run = sb_store_read_run(folder, &ignored);
    const json_t *platforms = json_object_get(run, "platforms");
    const struct sb_run_progress progress = sb_run_progress(run);
    const char *whole = sb_results_whole(folder, arena);
    if (platforms)
        warn_platforms(folder, platforms);
    else if (progress.stopped)
        sb_warn(
            "%s: the run is incomplete: its process %d was stopped, and the rows hold "
            "what was measured until then; go on with: shadebench run --resume %s",
            folder, progress.started, whole);
    else if (run && progress.complete < progress.wanted)
        sb_warn(
            "%s: the run is incomplete: %d of %d processes were measured; go on with: "
            "shadebench run --resume %s",
            folder, progress.complete, progress.wanted, whole);
    json_decref(run);
}

void sb_results_warn_gate(const char *folder)
{
    struct sb_arena arena = {0};
    json_t *gate = json_load_file(sb_path_join(&arena, folder, "gate.json"), 0, NULL);
    if (gate && !json_is_true(json_object_get(gate, "complete")))
        sb_warn("%s: the gate there is incomplete: pairs.csv has every pair until it was "
                "stopped, and no verdict is final; a gate is run anew, with another -o",
                folder);
    json_decref(gate);
    sb_arena_free(&arena);
}

// SB_BAD_INPUT
static bool fail_folder(const char *folder, struct sb_arena *arena, struct sb_error *err)
{
    if (!sb_file_exists(sb_path_join(arena, folder, "gate.csv")))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: the folder has no summary.csv; a results folder of "
                       "shadebench run is wanted",
                       folder);
    sb_results_warn_gate(folder);
    return sb_fail(err, SB_BAD_INPUT,
                   "%s: the folder is that of a gate, whose rows are in gate.csv; a "
                   "results folder of shadebench run is wanted",
                   folder);
}

bool sb_results_load(const struct sb_options *options, const char *word,
                     struct sb_compared *compared, struct sb_arena *arena,
                     struct sb_error *err)
{
    const char *folder = word;
    if (sb_dir_exists(word)) {
        compared->path = sb_path_join(arena, word, "summary.csv");
        if (!sb_file_exists(compared->path))
            return fail_folder(word, arena, err);
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
    warn_incomplete(folder, arena);
    return sb_rows_read(compared->path, compared->axes, &compared->rows, err);
}

void sb_results_free(struct sb_compared *compared)
{
    sb_rows_free(&compared->rows);
    sb_suite_free(&compared->suite);
}
