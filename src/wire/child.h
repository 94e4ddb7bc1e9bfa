// A process at the other end of a socket.
#pragma once

#include <stdbool.h>
#include <sys/types.h>

#include "base/error.h"
#include "base/text.h"

struct sb_child {
    pid_t pid; // 0: none; also the number of its process group
    int fd;    // its standard input and output
};

struct sb_child_params {
    const char *command;            // for /bin/sh
    const char *const *environment; // "NAME=VALUE" sets, "NAME" unsets
    int environment_count;
};

// Starts it in a process group of its own, so that a signal from the terminal is not its business.
// SB_INTERNAL where the system lets no process be started.
bool sb_child_start(const struct sb_child_params *params, struct sb_child *child,
                    struct sb_error *err);

// Closes the socket and waits: up to `seconds` for it to end by itself, then it is killed, with
// what it has started. Appends how it ended: "was killed by SIGSEGV", "ended with exit code 1";
// nothing where it had to be killed. One that even then is there after seconds is left behind, with a
// warning. Zeroes *child.
void sb_child_end(struct sb_child *child, double seconds, struct sb_text *how);
