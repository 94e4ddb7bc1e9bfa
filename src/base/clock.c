#include <time.h>

#include "base/clock.h"

static int64_t read_clock(clockid_t id)
{
    struct timespec t;
    clock_gettime(id, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

int64_t sb_clock_ns(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

int64_t sb_cpu_ns(void)
{
    return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

void sb_sleep_ns(int64_t ns)
{
    nanosleep(&(struct timespec){.tv_sec = ns / 1000000000, .tv_nsec = ns % 1000000000},
              NULL);
}

static void format_now(char *text, const char *format)
{
    const time_t now = time(NULL);
    struct tm utc;
    gmtime_r(&now, &utc);
    strftime(text, 32, format, &utc);
}

void sb_timestamp(char text[static 32])
{
    format_now(text, "%Y-%m-%dT%H:%M:%SZ");
}

void sb_timestamp_name(char text[static 32])
{
    format_now(text, "%Y%m%d-%H%M%S");
}
