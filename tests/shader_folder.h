// A shader folder that lives as long as a test.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include "test.h"

#include "base/file.h"

struct shader_folder {
    char root[64];
    char *name[160]; // what was made, parents before children
    int count;
    struct sb_arena arena;
};

static inline void folder_make(struct shader_folder *folder)
{
    *folder = (struct shader_folder){.root = "/tmp/sb-shaders-XXXXXX"};
    assert_non_null(mkdtemp(folder->root));
}

static inline void folder_keep(struct shader_folder *folder, char *path)
{
    for (int i = 0; i < folder->count; i++)
        if (!strcmp(folder->name[i], path))
            return;
    assert_in_range(folder->count, 0, 159);
    folder->name[folder->count++] = path;
}

// Writes a file, one folder deep at most, in place of one of that name.
static inline void folder_write_n(struct shader_folder *folder, const char *name,
                                  const char *data, size_t size)
{
    struct sb_error err = {0};
    char *path = sb_path_join(&folder->arena, folder->root, name);
    const char *slash = strchr(name, '/');
    if (slash) {
        char *parent = sb_arena_printf(&folder->arena, "%s/%.*s", folder->root,
                                       (int)(slash - name), name);
        assert_true(sb_dir_make(parent, &err));
        folder_keep(folder, parent);
    }
    assert_true(sb_file_replace(path, data, size, &err));
    folder_keep(folder, path);
}

static inline void folder_write(struct shader_folder *folder, const char *name,
                                const char *text)
{
    folder_write_n(folder, name, text, strlen(text));
}

static inline void folder_free(struct shader_folder *folder)
{
    for (int i = folder->count - 1; i >= 0; i--)
        if (unlink(folder->name[i]) != 0)
            rmdir(folder->name[i]);
    rmdir(folder->root);
    sb_arena_free(&folder->arena);
}
