// A message of the conversation with a worker, and its way over a pipe or socket
// (docs/formats.md, "Worker protocol"):
//
//   "SBW1"  length of head: uint32  length of payload: uint64  head: JSON object  payload
//
// Numbers are little-endian. Nothing stands between messages.
#pragma once

#include <jansson.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

#define SB_FRAME_HEAD_LIMIT    ((size_t)64 << 20)
#define SB_FRAME_PAYLOAD_LIMIT ((size_t)4 << 30)

struct sb_frame {
    json_t *head; // owned, as the payload is
    unsigned char *payload;
    size_t size; // of the payload
};
void sb_frame_free(struct sb_frame *frame); // zeroes it

enum sb_frame_end {
    SB_FRAME_OK,
    SB_FRAME_CLOSED,  // the other side is gone
    SB_FRAME_GARBAGE, // what came is no message; err has its first bytes
    SB_FRAME_LATE,    // nothing, or not all of it, until the deadline
};

#define SB_NO_DEADLINE INT64_MAX

// Both wait until `deadline` of sb_clock_ns at most; a signal does not end the wait. Nobody is
// sent SIGPIPE over a socket. *frame must be zeroed; it stays so unless SB_FRAME_OK.
enum sb_frame_end sb_frame_write(int fd, const struct sb_frame *frame, int64_t deadline);
enum sb_frame_end sb_frame_read(int fd, struct sb_frame *frame, int64_t deadline,
                                struct sb_error *err);
