#include "results/history_file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"
#include "results/history_time.h"

// --- appending -------------------------------------------------------------------------------

static bool fail_write(const char *path, struct sb_error *err)
{
    return sb_fail(err, SB_WRITE_FAILED, "%s: %s; the rows written before are whole",
                   path, strerror(errno));
}

static bool read_at(int file, off_t at, char *to, size_t count)
{
    ssize_t got;
    do
        got = pread(file, to, count, at);
    while (got < 0 && errno == EINTR);
    return got == (ssize_t)count;
}

// Behind the end of the last whole line.
static off_t find_end(int file, off_t size)
{
    char byte;
    while (size > 0 && read_at(file, size - 1, &byte, 1) && byte != '\n')
        size--;
    return size;
}

static bool fail_header(const char *path, struct sb_error *err)
{
    return sb_fail(err, SB_BAD_INPUT,
                   "%s:1: is not the header of a history of this version; name another "
                   "file",
                   path);
}

// *end: behind the last whole line, 0 where not even the header is whole.
static bool check_header(int file, const char *path, const struct sb_text *header,
                         off_t *end, struct sb_error *err)
{
    struct stat info;
    if (fstat(file, &info) != 0)
        return fail_write(path, err);
    if (!S_ISREG(info.st_mode))
        return sb_fail(err, SB_BAD_INPUT, "%s: is no regular file", path);
    const size_t length = header->length;
    const size_t there = info.st_size < (off_t)length ? (size_t)info.st_size : length;
    char *first = sb_alloc(length + 1);
    const bool read = read_at(file, 0, first, there);
    const bool same = read && memcmp(first, header->data, there) == 0;
    free(first);
    if (!same)
        return fail_header(path, err);
    *end = there < length ? 0 : find_end(file, info.st_size);
    return true;
}

static bool write_all(int file, const char *path, const struct sb_text *text, off_t end,
                      struct sb_error *err)
{
    for (size_t done = 0; done < text->length;) {
        const ssize_t count = write(file, text->data + done, text->length - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            goto error;
        done += (size_t)count;
    }
    if (fsync(file) == 0)
        return true;
error:
    fail_write(path, err);
    if (ftruncate(file, end) != 0)
        sb_fail(err, SB_WRITE_FAILED, "%s: %s; its last line may be a half one", path,
                strerror(errno));
    return false;
}

static bool append(int file, const char *path, const struct sb_history_row *rows,
                   int count, struct sb_error *err)
{
    struct sb_text header = {0}, text = {0};
    off_t end = 0;
    sb_csv_header(&header, sb_history_columns, sb_history_column_count, NULL);
    bool good = check_header(file, path, &header, &end, err);
    if (good && ftruncate(file, end) != 0)
        good = fail_write(path, err);
    if (good && end == 0)
        sb_text_add(&text, header.data);
    for (int i = 0; i < count; i++)
        sb_csv_row(&text, sb_history_columns, sb_history_column_count, NULL, &rows[i]);
    good = good && write_all(file, path, &text, end, err);
    sb_text_free(&text);
    sb_text_free(&header);
    return good;
}

bool sb_history_append(const char *path, const struct sb_history_row *rows, int count,
                       struct sb_error *err)
{
    const int file = open(path, O_RDWR | O_APPEND | O_CREAT | O_NONBLOCK, 0666);
    if (file < 0)
        return sb_fail(err, SB_BAD_INPUT, "%s: %s; name a file that can be written", path,
                       strerror(errno));
    // What lockf would do, which is no part of POSIX's base.
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    int locked;
    do
        locked = fcntl(file, F_SETLKW, &whole);
    while (locked != 0 && errno == EINTR);
    const bool good = locked == 0 ? append(file, path, rows, count, err)
                                  : sb_fail(err, SB_BAD_INPUT, "%s: cannot be locked: %s",
                                            path, strerror(errno));
    // Unlocks. What close could still say of the rows, fsync has said.
    close(file);
    return good;
}

// --- reading ---------------------------------------------------------------------------------

static bool check_columns(const struct sb_csv *csv, const char *path,
                          struct sb_error *err)
{
    bool same = csv->column_count == sb_history_column_count;
    for (int i = 0; same && i < sb_history_column_count; i++)
        same = strcmp(csv->cell[0][i], sb_history_columns[i].name) == 0;
    return same || fail_header(path, err);
}

static bool check_row(const struct sb_history_row *row, const char *path, int line,
                      struct sb_error *err)
{
    const struct {
        const char *name, *value;
    } wanted[] = {
        {"time", row->time},       {"commit", row->commit}, {"scene", row->scene},
        {"variant", row->variant}, {"status", row->status},
    };
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!wanted[i].value)
            return sb_fail(err, SB_BAD_INPUT, "%s:%d: %s is empty", path, line,
                           wanted[i].name);
    char time[32];
    if (!sb_history_time(row->time, time, NULL) || strcmp(time, row->time) != 0)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s:%d: time is \"%s\", a time such as 2026-11-22T01:02:03Z is "
                       "wanted",
                       path, line, row->time);
    if (isnan(row->ratio) ? strcmp(row->status, "ok") == 0
                          : !(row->ratio > 0 && isfinite(row->ratio)))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s:%d: ratio is %g, a number over 0 is wanted where the status "
                       "is ok",
                       path, line, row->ratio);
    return true;
}

bool sb_history_read(const char *path, struct sb_history *history, struct sb_error *err)
{
    struct sb_error cell;
    if (!sb_csv_read(path, &history->csv, err) ||
        !check_columns(&history->csv, path, err))
        return false;
    const int count = history->csv.row_count - 1;
    history->row = sb_alloc(((size_t)count + 1) * sizeof *history->row);
    for (int i = 0; i < count; i++) {
        struct sb_history_row *row = &history->row[i];
        sb_history_row_init(row);
        if (!sb_csv_get(&history->csv, i + 1, sb_history_columns, sb_history_column_count,
                        row, &cell))
            // "line 3: ratio is …", in the form of all other messages.
            return sb_fail(err, cell.status, "%s:%d: %s", path, i + 2,
                           cell.text + strcspn(cell.text, ":") + 2);
        if (!check_row(row, path, i + 2, err))
            return false;
        history->count++;
    }
    return true;
}

void sb_history_free(struct sb_history *history)
{
    free(history->row);
    sb_csv_free(&history->csv);
    *history = (struct sb_history){0};
}
