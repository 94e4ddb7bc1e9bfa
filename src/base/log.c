#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/log.h"

static enum sb_log_level current_level = SB_LOG_NORMAL;
static bool progress_shown;

void sb_log_set_level(enum sb_log_level level)
{
    current_level = level;
}

enum sb_log_level sb_log_level(void)
{
    return current_level;
}

static void say(const char *prefix, const char *format, va_list args)
{
    if (progress_shown)
        fputs("\r\033[K", stderr);
    progress_shown = false;
    fputs(prefix, stderr);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
}

void sb_warn(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say("shadebench: ", format, args);
    va_end(args);
}

void sb_info(const char *format, ...)
{
    if (current_level < SB_LOG_NORMAL)
        return;
    va_list args;
    va_start(args, format);
    say("", format, args);
    va_end(args);
}

void sb_debug(const char *format, ...)
{
    if (current_level < SB_LOG_VERBOSE)
        return;
    va_list args;
    va_start(args, format);
    say("  ", format, args);
    va_end(args);
}

void sb_progress(const char *text)
{
    static int64_t last_line_ns;
    if (current_level < SB_LOG_NORMAL)
        return;
    if (isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r\033[K%s", text);
        fflush(stderr);
        progress_shown = *text != '\0';
        return;
    }
    const int64_t now = sb_clock_ns();
    if (*text && now - last_line_ns >= 10 * INT64_C(1000000000)) {
        fprintf(stderr, "%s\n", text);
        last_line_ns = now;
    }
}
