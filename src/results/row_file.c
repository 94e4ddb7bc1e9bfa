#include "results/row_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "results/csv.h"

struct sb_row_file {
    const struct sb_column *column;
    int column_count;
    int descriptor;
    const char *path;
    struct sb_text text; // scratch
    struct sb_arena arena;
};

// Of a start that came to nothing there is a header at most.
static bool check_free(const char *path, struct sb_error *err)
{
    struct sb_arena arena = {0};
    if (!sb_file_exists(path))
        return true;
    const char *data = sb_file_read(&arena, path, (size_t)64 << 20, NULL, err);
    const char *end = data ? strchr(data, '\n') : NULL;
    const bool rows = end && end[1];
    sb_arena_free(&arena);
    if (!data)
        return false;
    return !rows ||
           sb_fail(err, SB_BAD_INPUT, "%s exists; name another folder with -o", path);
}

// All of it, or nothing: a row that does not fit is cut off again.
static bool append(struct sb_row_file *file, struct sb_error *err)
{
    const off_t before = lseek(file->descriptor, 0, SEEK_END);
    for (size_t done = 0; done < file->text.length;) {
        const ssize_t count =
            write(file->descriptor, file->text.data + done, file->text.length - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0) {
            sb_fail(err, SB_WRITE_FAILED, "%s: %s; the rows written before are whole",
                    file->path, strerror(errno));
            const int ignored = ftruncate(file->descriptor, before < 0 ? 0 : before);
            (void)ignored; // a device cannot be cut
            return false;
        }
        done += (size_t)count;
    }
    return true;
}

struct sb_row_file *sb_row_file_open(const struct sb_row_file_params *params,
                                     struct sb_error *err)
{
    if (!sb_dir_make(params->dir, err))
        return NULL;
    struct sb_row_file *file = sb_alloc(sizeof *file);
    file->column = params->column;
    file->column_count = params->column_count;
    file->descriptor = -1;
    file->path = sb_path_join(&file->arena, params->dir, params->name);
    if (!check_free(file->path, err))
        goto error;
    file->descriptor = open(file->path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file->descriptor < 0) {
        sb_fail(err, SB_BAD_INPUT, "%s: %s; name a folder that can be written with -o",
                file->path, strerror(errno));
        goto error;
    }
    sb_csv_header(&file->text, file->column, file->column_count, NULL);
    if (append(file, err))
        return file;
error:
    sb_row_file_close(&file);
    return NULL;
}

bool sb_row_file_add(struct sb_row_file *file, const void *rows, int count, size_t size,
                     struct sb_error *err)
{
    sb_text_clear(&file->text);
    for (int i = 0; i < count; i++)
        sb_csv_row(&file->text, file->column, file->column_count, NULL,
                   (const char *)rows + (size_t)i * size);
    return append(file, err);
}

bool sb_row_file_replace(struct sb_row_file *file, const void *rows, int count,
                         size_t size, struct sb_error *err)
{
    sb_text_clear(&file->text);
    sb_csv_header(&file->text, file->column, file->column_count, NULL);
    for (int i = 0; i < count; i++)
        sb_csv_row(&file->text, file->column, file->column_count, NULL,
                   (const char *)rows + (size_t)i * size);
    return sb_file_replace(file->path, file->text.data, file->text.length, err);
}

const char *sb_row_file_path(const struct sb_row_file *file)
{
    return file->path;
}

void sb_row_file_close(struct sb_row_file **file)
{
    if (!*file)
        return;
    if ((*file)->descriptor >= 0)
        close((*file)->descriptor);
    sb_text_free(&(*file)->text);
    struct sb_arena arena = (*file)->arena; // holds the path, not the struct
    sb_arena_free(&arena);
    free(*file);
    *file = NULL;
}
