#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"

const struct sb_status_row sb_status_rows[SB_STATUS_COUNT] = {
#define STATUS(id, word, code, help) [SB_##id] = {word, code, help},
#include "base/status.def"
#undef STATUS
};

bool sb_fail(struct sb_error *err, enum sb_status status, const char *format, ...)
{
    if (!err)
        return false;
    // The new text may quote the old one, so it is made aside.
    char text[sizeof err->text];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    memcpy(err->text, text, sizeof text);
    err->status = status;
    return false;
}

enum sb_status sb_status_find(const char *word)
{
    int i = 0;
    while (i < SB_STATUS_COUNT && strcmp(sb_status_rows[i].word, word) != 0)
        i++;
    return (enum sb_status)i;
}

int sb_exit_code_worse(int a, int b)
{
    static const int order[] = {2, 77, 3, 1, 4, 130, 0};
    for (size_t i = 0; i < sizeof order / sizeof *order; i++)
        if (a == order[i] || b == order[i])
            return order[i];
    return a;
}
