#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "results/csv.h"
#include "results/store.h"

struct sb_store {
    FILE *samples;
    const struct sb_axes *axes;
    const char *dir, *samples_path, *summary_path, *run_path;
    struct sb_text text; // scratch, kept so that a round allocates nothing
    struct sb_arena arena;
};

// A killed writer leaves half a line: cut it, or the next row would be glued to it.
static bool cut_half_line(const char *path, struct sb_error *err)
{
    struct sb_arena arena = {0};
    size_t size;
    char *data = sb_file_read(&arena, path, (size_t)1 << 30, &size, err);
    bool good = data != NULL;
    if (good && size && data[size - 1] != '\n') {
        const char *end = strrchr(data, '\n');
        if (truncate(path, end ? end + 1 - data : 0) != 0)
            good = sb_fail(err, SB_BAD_INPUT, "%s: %s", path, strerror(errno));
    }
    sb_arena_free(&arena);
    return good;
}

static bool open_samples(struct sb_store *store, bool append, struct sb_error *err)
{
    const bool there = sb_file_exists(store->samples_path);
    if (there && !append)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s exists; name another folder with -o, or go on with it: "
                       "run --resume %s",
                       store->samples_path, store->dir);
    if (there && !cut_half_line(store->samples_path, err))
        return false;
    store->samples = fopen(store->samples_path, "ab");
    if (!store->samples)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: %s; name a folder that can be written with -o",
                       store->samples_path, strerror(errno));
    fseek(store->samples, 0, SEEK_END);
    return ftell(store->samples) > 0 || sb_store_samples(store, NULL, 0, err);
}

// A suite's own axis must not hide a column.
static bool check_names(const struct sb_axes *axes, struct sb_error *err)
{
    for (int i = 0; i < sb_summary_column_count; i++)
        if (sb_summary_columns[i].name &&
            sb_axes_find(axes, sb_summary_columns[i].name) >= 0)
            return sb_fail(err, SB_BAD_INPUT,
                           "an axis cannot be called \"%s\": summary.csv has a column of "
                           "that name",
                           sb_summary_columns[i].name);
    return true;
}

struct sb_store *sb_store_open(const struct sb_store_params *params, struct sb_error *err)
{
    if (!check_names(params->axes, err) || !sb_dir_make(params->dir, err))
        return NULL;
    struct sb_store *store = sb_alloc(sizeof *store);
    store->axes = params->axes;
    store->dir = sb_arena_strdup(&store->arena, params->dir);
    store->samples_path = sb_path_join(&store->arena, params->dir, "samples.csv");
    store->summary_path = sb_path_join(&store->arena, params->dir, "summary.csv");
    store->run_path = sb_path_join(&store->arena, params->dir, "run.json");
    if (!open_samples(store, params->append, err))
        sb_store_close(&store);
    return store;
}

void sb_store_close(struct sb_store **store)
{
    if (!*store)
        return;
    if ((*store)->samples)
        fclose((*store)->samples);
    sb_text_free(&(*store)->text);
    struct sb_arena arena = (*store)->arena;
    sb_arena_free(&arena);
    free(*store);
    *store = NULL;
}

const char *sb_store_dir(const struct sb_store *store)
{
    return store->dir;
}

// Without rows: the header, for a new file.
bool sb_store_samples(struct sb_store *store, const struct sb_sample_row *rows, int count,
                      struct sb_error *err)
{
    struct sb_text *text = &store->text;
    sb_text_clear(text);
    if (!rows)
        sb_csv_header(text, sb_sample_columns, sb_sample_column_count, NULL);
    for (int i = 0; i < count; i++)
        sb_csv_row(text, sb_sample_columns, sb_sample_column_count, NULL, &rows[i]);
    if (fwrite(text->data, 1, text->length, store->samples) != text->length ||
        fflush(store->samples) != 0)
        return sb_fail(err, SB_WRITE_FAILED,
                       "%s: %s; the rounds written before are whole", store->samples_path,
                       strerror(errno));
    return true;
}

bool sb_store_summary(struct sb_store *store, const struct sb_row *rows, int count,
                      struct sb_error *err)
{
    struct sb_text *text = &store->text;
    sb_text_clear(text);
    sb_csv_header(text, sb_summary_columns, sb_summary_column_count, store->axes);
    for (int i = 0; i < count; i++)
        sb_csv_row(text, sb_summary_columns, sb_summary_column_count, store->axes,
                   &rows[i]);
    return sb_file_replace(store->summary_path, text->data, text->length, err);
}

bool sb_store_run(struct sb_store *store, const json_t *run, struct sb_error *err)
{
    char *text = json_dumps(run, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    if (!text)
        return sb_fail(err, SB_INTERNAL, "run.json: not a JSON value");
    const bool good = sb_file_replace(store->run_path, text, strlen(text), err);
    free(text);
    return good;
}

json_t *sb_store_read_run(const char *dir, struct sb_error *err)
{
    struct sb_arena arena = {0};
    const char *path = sb_path_join(&arena, dir, "run.json");
    json_t *run = NULL;
    json_error_t cause;
    char *data = sb_file_read(&arena, path, (size_t)64 << 20, NULL, err);
    if (data && !(run = json_loads(data, 0, &cause)))
        sb_fail(err, SB_BAD_INPUT, "%s:%d:%d: %s", path, cause.line, cause.column,
                cause.text);
    sb_arena_free(&arena);
    return run;
}
