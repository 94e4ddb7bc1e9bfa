// Counters of this process's instructions in user space, all its threads: one table. Where a
// software driver draws, they are what a frame costs, whatever else the machine does meanwhile.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

struct sb_counter_fns;

struct sb_counter {
    const struct sb_counter_fns *fns; // NULL: nothing counts
    const char *folder;               // callgrind: where its files go; borrowed
    int fd;                           // perf_event
    int64_t begin, end;
};

struct sb_counter_fns {
    const char *name, *help;
    bool (*open)(struct sb_counter *); // false: this process has no such counter
    // Between these nothing but what is counted; each costs a few instructions of its own.
    void (*start)(struct sb_counter *);
    void (*stop)(struct sb_counter *);
    // After a stop: the instructions since the start.
    bool (*read)(struct sb_counter *, int64_t *instructions, struct sb_error *err);
    void (*close)(struct sb_counter *);
};
extern const struct sb_counter_fns
    *const sb_counters[]; // in order of preference; ends with NULL

// The first that this process has; false, and *counter zeroed: none. Before a driver makes its
// threads: those made earlier are not counted. `folder`: of callgrind's files, NULL: it cannot
// count.
bool sb_counter_open(struct sb_counter *counter, const char *folder);
void sb_counter_close(struct sb_counter *counter); // zeroes it
