// What a run says while it works, all of it on stderr: results belong on stdout.
#pragma once

enum sb_log_level { SB_LOG_QUIET, SB_LOG_NORMAL, SB_LOG_VERBOSE };

void sb_log_set_level(enum sb_log_level level);
enum sb_log_level sb_log_level(void);

void sb_warn(const char *format, ...) __attribute__((format(printf, 1, 2))); // always
void sb_info(const char *format, ...)
    __attribute__((format(printf, 1, 2))); // not --quiet
void sb_debug(const char *format, ...)
    __attribute__((format(printf, 1, 2))); // --verbose only

// A line that is overwritten by the next one on a terminal; elsewhere a plain line, at
// most one every ten seconds. An empty text erases it.
void sb_progress(const char *text);
