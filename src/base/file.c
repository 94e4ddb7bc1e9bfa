#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"

char *sb_file_read(struct sb_arena *arena, const char *path, size_t limit, size_t *size,
                   struct sb_error *err)
{
    struct stat info;
    FILE *file = fopen(path, "rb");
    if (!file || fstat(fileno(file), &info) != 0) {
        sb_fail(err, SB_BAD_INPUT, "%s: %s", path, strerror(errno));
        goto error;
    }
    if (S_ISDIR(info.st_mode)) {
        sb_fail(err, SB_BAD_INPUT, "%s: is a directory, a file is wanted", path);
        goto error;
    }
    if ((unsigned long long)info.st_size > limit) {
        sb_fail(err, SB_BAD_INPUT, "%s: %lld bytes; at most %zu are read", path,
                (long long)info.st_size, limit);
        goto error;
    }
    // Pipes and /dev/stdin have no size: read until the end, or until the limit.
    const size_t room = info.st_size > 0 ? (size_t)info.st_size : limit;
    char *data = sb_arena_alloc(arena, room + 1);
    const size_t got = fread(data, 1, room, file);
    if (ferror(file)) {
        sb_fail(err, SB_BAD_INPUT, "%s: %s", path, strerror(errno));
        goto error;
    }
    data[got] = '\0';
    if (size)
        *size = got;
    fclose(file);
    return data;

error:
    if (file)
        fclose(file);
    return NULL;
}

// `temporary` is beside `path`, and nobody else writes to it.
static bool replace_by(const char *temporary, const char *path, const char *data,
                       size_t size, struct sb_error *err)
{
    FILE *file = fopen(temporary, "wb");
    bool good = file && fwrite(data, 1, size, file) == size && fflush(file) == 0;
    int cause = errno;
    if (file && fclose(file) != 0 && good) {
        cause = errno;
        good = false;
    }
    if (good && rename(temporary, path) != 0) {
        cause = errno;
        good = false;
    }
    if (good)
        return true;
    if (file)
        unlink(temporary);
    return sb_fail(err, SB_WRITE_FAILED, "%s: %s", path, strerror(cause));
}

bool sb_file_replace(const char *path, const char *data, size_t size,
                     struct sb_error *err)
{
    struct sb_arena arena = {0};
    const char *temporary = sb_arena_printf(&arena, "%s.tmp", path);
    const bool good = replace_by(temporary, path, data, size, err);
    sb_arena_free(&arena);
    return good;
}

bool sb_file_replace_shared(const char *path, const char *data, size_t size,
                            struct sb_error *err)
{
    struct sb_arena arena = {0};
    const char *temporary = sb_arena_printf(&arena, "%s.%ld.tmp", path, (long)getpid());
    const bool good = replace_by(temporary, path, data, size, err);
    sb_arena_free(&arena);
    return good;
}

bool sb_file_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && !S_ISDIR(info.st_mode);
}

bool sb_dir_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

bool sb_dir_make(const char *path, struct sb_error *err)
{
    if (!path[0])
        return sb_fail(err, SB_BAD_INPUT, "the name of a folder is empty");
    char *copy = sb_strdup(path);
    bool good = true;
    for (char *p = copy + 1; good; p++) {
        if (*p != '/' && *p != '\0')
            continue;
        const char kept = *p;
        *p = '\0';
        if (mkdir(copy, 0777) != 0 && !sb_dir_exists(copy))
            good = sb_fail(err, SB_BAD_INPUT, "%s: cannot make the folder: %s", copy,
                           strerror(errno == EEXIST ? ENOTDIR : errno));
        *p = kept;
        if (kept == '\0')
            break;
    }
    free(copy);
    return good;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

char **sb_dir_list(struct sb_arena *arena, const char *path, const char *suffix,
                   int *count, struct sb_error *err)
{
    DIR *dir = opendir(path);
    if (!dir) {
        sb_fail(err, SB_BAD_INPUT, "%s: %s", path, strerror(errno));
        return NULL;
    }
    char **names = NULL;
    int capacity = 0;
    *count = 0;
    for (struct dirent *entry; (entry = readdir(dir));) {
        const size_t length = strlen(entry->d_name), tail = strlen(suffix);
        if (length <= tail || strcmp(entry->d_name + length - tail, suffix) != 0)
            continue;
        names = sb_grow(names, *count, &capacity, sizeof *names);
        names[(*count)++] = sb_arena_strdup(arena, entry->d_name);
    }
    closedir(dir);
    if (*count)
        qsort(names, (size_t)*count, sizeof *names, by_name);
    char **result = sb_arena_alloc(arena, ((size_t)*count + 1) * sizeof *result);
    if (*count)
        memcpy(result, names, (size_t)*count * sizeof *result);
    free(names);
    return result;
}

char *sb_temporary_dir(struct sb_arena *arena, const char *prefix, struct sb_error *err)
{
    const char *place = getenv("TMPDIR");
    if (!place || !place[0])
        place = "/tmp";
    char *path = sb_arena_printf(arena, "%s/%s-XXXXXX", place, prefix);
    if (mkdtemp(path))
        return path;
    sb_fail(err, SB_WRITE_FAILED, "no temporary folder can be made in %s: %s", place,
            strerror(errno));
    return NULL;
}

void sb_dir_remove(const char *path)
{
    struct sb_arena arena = {0};
    int count = 0;
    char **name = sb_dir_list(&arena, path, "", &count, NULL);
    for (int i = 0; name && i < count; i++)
        unlink(
            sb_path_join(&arena, path, name[i])); // fails for "." and "..", as it should
    rmdir(path);
    sb_arena_free(&arena);
}

bool sb_in_path(const char *program)
{
    struct sb_arena arena = {0};
    const char *path = getenv("PATH");
    char *rest = sb_arena_strdup(&arena, path ? path : ""), *folder;
    bool found = false;
    while (!found && (folder = strtok_r(rest, ":", &rest)))
        found = access(sb_path_join(&arena, folder, program), X_OK) == 0;
    sb_arena_free(&arena);
    return found;
}

char *sb_path_join(struct sb_arena *arena, const char *folder, const char *name)
{
    if (name[0] == '/' || !folder[0])
        return sb_arena_strdup(arena, name);
    const bool slash = folder[strlen(folder) - 1] == '/';
    return sb_arena_printf(arena, "%s%s%s", folder, slash ? "" : "/", name);
}

char *sb_executable(struct sb_arena *arena, struct sb_error *err)
{
    char path[4096];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    if (length < 0) {
        sb_fail(err, SB_INTERNAL, "/proc/self/exe: %s", strerror(errno));
        return NULL;
    }
    path[length] = '\0';
    return sb_arena_strdup(arena, path);
}

char *sb_data_dir(struct sb_arena *arena, const char *given, struct sb_error *err)
{
    const char *source = "--data";
    char *dir = given ? sb_arena_strdup(arena, given) : NULL;
    if (!dir && getenv("SHADEBENCH_DATA")) {
        source = "$SHADEBENCH_DATA";
        dir = sb_arena_strdup(arena, getenv("SHADEBENCH_DATA"));
    }
    if (!dir) {
        source = "the installation";
        dir = sb_executable(arena, err);
        if (!dir)
            return NULL;
        *strrchr(dir, '/') = '\0';
        dir = sb_path_join(arena, dir, "../share/shadebench");
    }
    if (!sb_dir_exists(sb_path_join(arena, dir, "shaders"))) {
        sb_fail(err, SB_BAD_INPUT,
                "no folder shaders/ in %s (from %s); give the folder that holds shaders/ "
                "and bench/ with --data DIR or SHADEBENCH_DATA",
                dir, source);
        return NULL;
    }
    return dir;
}
