// The entries of Google Benchmark's reports: what its JSON and its CSV both list.
#pragma once

#include "export/formats.h"

struct sb_gbench_entry {
    const struct sb_export_row *row;
    int family;             // place among the rows
    const char *aggregate;  // "mean", "median", "stddev", "cv"; NULL: a sample
    bool whole;             // of the row as a whole: counters and label stand here
    bool failed;            // no time, and why
    int index;              // of a sample
    int repetitions;        // samples of the row
    double real_ns, cpu_ns; // a frame; of "cv" shares. cpu 0: not known
};

struct sb_gbench_entries {
    struct sb_gbench_entry *entry;
    int count, capacity;
};

// Of all rows in their order: an entry a sample, then what Google Benchmark calls aggregates. Without
// the samples only those of them that are levels, and nothing of rows without a time.
void sb_gbench_entries_make(const struct sb_export *export, bool samples,
                            struct sb_gbench_entries *entries);
void sb_gbench_entries_free(struct sb_gbench_entries *entries);

// "room/point=8_median".
void sb_gbench_name(const struct sb_gbench_entry *entry, struct sb_text *text);

// Why one that failed has no time: its status and message, and what was counted instead.
void sb_gbench_why(const struct sb_gbench_entry *entry, struct sb_text *text);

// What an entry has besides its times, for each a call: those of the row, its interval and ratio.
void sb_gbench_counters(const struct sb_gbench_entry *entry,
                        void (*each)(const struct sb_export_counter *counter, void *user),
                        void *user);
