// Timer sources: a ladder of ways to ask GL how long a batch took. Each is a row; which
// one tells the truth here is found out by the audit (gl/audit.c reads, stats/audit.h
// judges).
#pragma once

#include "gl/gl.h"

// Query objects for one timed span. GL ties an object to the target of its first use: a
// query serves one source.
struct sb_query {
    GLuint name[2];
};

enum sb_read { SB_READ_OK, SB_READ_LATER, SB_READ_DISJOINT };

struct sb_timer_fns {
    const char *name, *help; // "elapsed+finish": the word in --timer and timer_source
    bool (*usable)(const struct sb_caps *caps);
    int (*bits)(const struct sb_caps *caps); // of its counter; 0: it reads no query
    void (*begin)(struct sb_query *query);
    void (*end)(struct sb_query *query);
    // After the batch was drained. 0 ns is a value, never "none": SB_NO_TIME says that
    // the source reads no query, and the drained wall time of the batch is its answer.
    // *ns is set with SB_READ_OK and with SB_READ_DISJOINT, where it is worth nothing.
    enum sb_read (*read)(struct sb_query *query, const struct sb_caps *caps, int64_t *ns);
};
extern const struct sb_timer_fns *const sb_timers[]; // in ladder order, ends with NULL

// Reads, waiting up to one second for drivers that deliver late; then SB_READ_LATER.
enum sb_read sb_timer_read(const struct sb_timer_fns *timer, struct sb_query *query,
                           const struct sb_caps *caps, int64_t *ns);

void sb_query_make(struct sb_query *query);
void sb_query_free(struct sb_query *query);
