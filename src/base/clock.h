// Clocks, in nanoseconds.
#pragma once

#include <stdint.h>

int64_t sb_clock_ns(void); // CLOCK_MONOTONIC
int64_t sb_cpu_ns(void);   // CPU time of this process, all threads
void sb_sleep_ns(int64_t ns);

// Now, in UTC, as 2026-11-22T01:02:03Z and, for names of folders, as 20261122-010203.
void sb_timestamp(char text[static 32]);
void sb_timestamp_name(char text[static 32]);
