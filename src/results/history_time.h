// Times of a history, so that those of many writers sort as text does.
#pragma once

#include "base/error.h"

// "2026-11-22", "2026-11-22T01:02:03Z" or "2026-11-22T03:02:03+02:00", as `git show -s
// --format=%cI` writes them, in UTC, as 2026-11-22T01:02:03Z. SB_USAGE.
bool sb_history_time(const char *given, char time[static 32], struct sb_error *err);
