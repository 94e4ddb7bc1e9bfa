// What the files of `history` share.
#pragma once

#include "analyse/history.h"
#include "cli/common.h"

#define SB_HISTORY_FILE "shadebench-history.csv"

int sb_history_show(const struct sb_options *options);                  // the exit code
void sb_history_print_wide(const struct sb_history_analysis *analysis); // to stdout
