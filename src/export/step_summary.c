#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/formats.h"

bool sb_export_step_summary(const struct sb_export *export, struct sb_error *err)
{
    const char *path = getenv("GITHUB_STEP_SUMMARY");
    if (!path || !path[0])
        return true;
    struct sb_text text = {0};
    sb_export_markdown(export, &text);
    sb_text_add(&text, "\n"); // what another step appends is a paragraph of its own
    FILE *file = fopen(path, "ab");
    bool good = file && fwrite(text.data, 1, text.length, file) == text.length &&
                fflush(file) == 0;
    int cause = errno;
    if (file && fclose(file) != 0 && good) {
        cause = errno;
        good = false;
    }
    sb_text_free(&text);
    return good || sb_fail(err, SB_WRITE_FAILED, "$GITHUB_STEP_SUMMARY: %s: %s", path,
                           strerror(cause));
}
