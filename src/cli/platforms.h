// A plan over several platforms (two drivers, two APIs): one process has one driver, so each of
// them is a run of its own, by this program again, in a folder of its own under the results
// folder; the summary of all stands above them.
#pragma once

#include <jansson.h>

#include "cli/common.h"

struct sb_platforms {
    const char *
        *label; // "api=gles,driver=softpipe": what differs between the plan's platforms
    int count;  // 1: nothing does
};

// In the order of their first entries. The labels live in `arena`.
void sb_platforms_find(const struct sb_suite *suite, struct sb_platforms *platforms,
                       struct sb_arena *arena);

// Leaves the entries of one platform. SB_USAGE lists those there are.
bool sb_platforms_keep(struct sb_suite *suite, const char *label, struct sb_error *err);

struct sb_platforms_run {
    const struct sb_suite *suite;
    const struct sb_platforms *platforms;
    const char *dir;
    const char *suite_file;           // NULL: none
    const struct sb_options *options; // with --resume those of the first start, too
    const json_t *arguments;          // of this run, behind the word `run`
    bool quiet_output;                // the runs' tables are not wanted on stdout
};
struct sb_platforms_rows { // of all runs, in the order of the platforms
    struct sb_row *row;
    int count, room;
    bool interrupted; // this process, or a run: the rest was not begun
    struct sb_arena arena;
};
// Runs them one after another, and puts dir/summary.csv and dir/run.json together; the suite's copy is
// there, too. With --resume each is gone on with, or begun. Their worst exit code. `rows`
// must be zeroed; free also after failure.
int sb_platforms_run(const struct sb_platforms_run *run, struct sb_platforms_rows *rows);
void sb_platforms_rows_free(struct sb_platforms_rows *rows);

// run.json of the whole: how far each platform has come, and the processes and entries of all.
bool sb_platforms_record(const struct sb_platforms_run *run, struct sb_error *err);
