#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "results/csv.h"
#include "results/store.h"

struct sb_store {
    int samples;        // descriptor, -1: not open
    off_t samples_size; // of its whole rounds
    const struct sb_axes *axes;
    const char *dir, *samples_path, *summary_path, *run_path;
    struct sb_text text; // scratch, kept so that a round allocates nothing
    struct sb_arena arena;
};

// Looks at what samples.csv holds: the size of its whole lines, since a killed writer leaves
// half a line that the next row would be glued to, and whether any of them is a sample.
static bool examine_samples(struct sb_store *store, bool *measured, struct sb_error *err)
{
    struct sb_arena arena = {0};
    size_t size;
    const char *data =
        sb_file_read(&arena, store->samples_path, (size_t)1 << 30, &size, err);
    if (data) {
        const char *end = strrchr(data, '\n');
        store->samples_size = end ? end + 1 - data : 0;
        *measured = end && strchr(data, '\n') != end;
    }
    sb_arena_free(&arena);
    return data != NULL;
}

// A start that failed before it measured leaves a header, which is no result.
static bool open_samples(struct sb_store *store, bool append, struct sb_error *err)
{
    bool measured = false;
    if (sb_file_exists(store->samples_path) && !examine_samples(store, &measured, err))
        return false;
    if (!append && (measured || sb_file_exists(store->run_path)))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s exists; name another folder with -o, or go on with it: "
                       "run --resume %s",
                       measured ? store->samples_path : store->run_path, store->dir);
    store->samples = open(store->samples_path, O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (store->samples < 0)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: %s; name a folder that can be written with -o",
                       store->samples_path, strerror(errno));
    if (store->samples_size == 0)
        return sb_store_samples(store, NULL, 0, err);
    if (ftruncate(store->samples, store->samples_size) != 0)
        return sb_fail(err, SB_BAD_INPUT, "%s: %s", store->samples_path, strerror(errno));
    return true;
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
    store->samples = -1;
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
    if ((*store)->samples >= 0)
        close((*store)->samples);
    sb_text_free(&(*store)->text);
    struct sb_arena arena = (*store)->arena;
    sb_arena_free(&arena);
    free(*store);
    *store = NULL;
}

// All of it, or nothing: a round that does not fit is cut off again.
static bool append_samples(struct sb_store *store, const char *data, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t count = write(store->samples, data + done, size - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0) {
            const int cause = errno;
            const int ignored = ftruncate(store->samples, store->samples_size);
            (void)ignored; // a device cannot be cut
            errno = cause;
            return false;
        }
        done += (size_t)count;
    }
    store->samples_size += (off_t)size;
    return true;
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
    if (!append_samples(store, text->data, text->length))
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

static bool write_run(const char *path, const json_t *run, struct sb_error *err)
{
    char *text = json_dumps(run, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    if (!text)
        return sb_fail(err, SB_INTERNAL, "run.json: not a JSON value");
    const bool good = sb_file_replace(path, text, strlen(text), err);
    free(text);
    return good;
}

bool sb_store_run(struct sb_store *store, const json_t *run, struct sb_error *err)
{
    return write_run(store->run_path, run, err);
}

bool sb_store_run_in(const char *dir, const json_t *run, struct sb_error *err)
{
    struct sb_arena arena = {0};
    const bool good = write_run(sb_path_join(&arena, dir, "run.json"), run, err);
    sb_arena_free(&arena);
    return good;
}

static bool is_run(const json_t *run)
{
    static const char *const lists[] = {"arguments", "entries", "processes"};
    for (int i = 0; i < 3; i++)
        if (!json_is_array(json_object_get(run, lists[i])))
            return false;
    return true;
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
    if (run && !is_run(run)) {
        sb_fail(err, SB_BAD_INPUT, "%s: not the record of a run", path);
        json_decref(run);
        run = NULL;
    }
    sb_arena_free(&arena);
    return run;
}
