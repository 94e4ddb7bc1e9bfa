// The line to a worker: one process after another, of which at most one runs, and the exchange of
// messages with it. What is lost with a worker, and who is to blame, is worker.c's business.
#pragma once

#include "base/mem.h"
#include "job/job.h"
#include "wire/child.h"
#include "wire/frame.h"

struct sb_connection {
    struct sb_context_params params; // its texts live in `arena`
    struct sb_caps caps;             // of the first worker
    struct sb_child child;           // pid 0: none runs
    int count;                       // workers started, this one included
    int timer;                       // source in use; -1: none
    struct sb_arena arena;
};

// Starts a worker and opens its context. Close also after failure.
bool sb_connection_open(struct sb_connection *line,
                        const struct sb_context_params *params, struct sb_error *err);
void sb_connection_close(struct sb_connection *line);
// Ends the worker; sb_connection_ensure starts the next one.
void sb_connection_renew(struct sb_connection *line);

bool sb_connection_lost(const struct sb_connection *line); // no worker runs
// Starts a fresh one where none runs, with the timer in use. It must find the same driver: else its
// times would stand beside those of another.
bool sb_connection_ensure(struct sb_connection *line, struct sb_error *err);
bool sb_connection_tell_timer(struct sb_connection *line, struct sb_error *err);

// Each of these is false with the runner's own error, or with a worker that is lost:
// SB_WORKER_CRASHED, _HUNG or _GARBAGE, which begins with what was being done, `doing`.

// Request and answer. *answer must be zeroed; it is filled only on success.
bool sb_connection_exchange(struct sb_connection *line, const char *doing,
                            const struct sb_frame *request, struct sb_frame *answer,
                            struct sb_error *err);
bool sb_connection_send(struct sb_connection *line, const char *doing,
                        const struct sb_frame *request, struct sb_error *err);
bool sb_connection_receive(struct sb_connection *line, const char *doing,
                           struct sb_frame *answer, struct sb_error *err);
// What an answer says.
bool sb_connection_accept(struct sb_connection *line, const char *doing,
                          const struct sb_frame *answer, struct sb_error *err);
// A part of an answer cannot be read (*err): the worker is not to be believed any more, and ended.
bool sb_connection_distrust(struct sb_connection *line, const char *doing,
                            struct sb_error *err);
