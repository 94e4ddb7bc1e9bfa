#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "export/export.h"

// rename(2) would put a file where a pipe or a device was.
static bool write_into(const char *path, const struct sb_text *text, struct sb_error *err)
{
    FILE *file = fopen(path, "wb");
    bool good = file && fwrite(text->data, 1, text->length, file) == text->length &&
                fflush(file) == 0;
    int cause = errno;
    if (file && fclose(file) != 0 && good) {
        cause = errno;
        good = false;
    }
    return good || sb_fail(err, SB_WRITE_FAILED, "%s: %s", path, strerror(cause));
}

bool sb_export_write(const struct sb_export *export,
                     const struct sb_export_format *format, const char *path,
                     struct sb_error *err)
{
    struct stat info;
    struct sb_text text = {0};
    format->write(export, &text);
    const bool special = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
    const bool good = special ? write_into(path, &text, err)
                              : sb_file_replace(path, text.data, text.length, err);
    sb_text_free(&text);
    return good;
}
