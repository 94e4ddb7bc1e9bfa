#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/mem.h"
#include "base/text.h"
#include "wire/frame.h"

enum { PREFIX = 16 };
static const char magic[4] = {'S', 'B', 'W', '1'};

void sb_frame_free(struct sb_frame *frame)
{
    json_decref(frame->head);
    free(frame->payload);
    *frame = (struct sb_frame){0};
}

static void put_little(unsigned char *to, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (unsigned char)(value >> (8 * i));
}

static uint64_t get_little(const unsigned char *from, int bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint64_t)from[i] << (8 * i);
    return value;
}

// False: the deadline has passed.
static bool wait_for(int fd, short events, int64_t deadline)
{
    for (;;) {
        int ms = -1;
        if (deadline != SB_NO_DEADLINE) {
            const int64_t left = (deadline - sb_clock_ns() + 999999) / 1000000;
            if (left <= 0)
                return false;
            ms = left < 3600000 ? (int)left : 3600000;
        }
        struct pollfd one = {.fd = fd, .events = events};
        const int ready = poll(&one, 1, ms);
        if (ready > 0 || (ready < 0 && errno != EINTR))
            return true; // an error shows in what follows
    }
}

// A pipe, as a worker behind another program may have, knows no flags.
static ssize_t write_some(int fd, const void *data, size_t size)
{
    const ssize_t sent = send(fd, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent < 0 && errno == ENOTSOCK ? write(fd, data, size) : sent;
}

static enum sb_frame_end write_all(int fd, const void *data, size_t size,
                                   int64_t deadline)
{
    const char *at = data;
    while (size > 0) {
        if (!wait_for(fd, POLLOUT, deadline))
            return SB_FRAME_LATE;
        const ssize_t done = write_some(fd, at, size);
        if (done < 0 && errno != EINTR && errno != EAGAIN)
            return SB_FRAME_CLOSED;
        if (done > 0) {
            at += done;
            size -= (size_t)done;
        }
    }
    return SB_FRAME_OK;
}

enum sb_frame_end sb_frame_write(int fd, const struct sb_frame *frame, int64_t deadline)
{
    unsigned char prefix[PREFIX];
    char *head = json_dumps(frame->head, JSON_COMPACT | JSON_REAL_PRECISION(17));
    if (!head)
        return SB_FRAME_GARBAGE;
    const size_t length = strlen(head);
    memcpy(prefix, magic, sizeof magic);
    put_little(prefix + 4, length, 4);
    put_little(prefix + 8, frame->size, 8);
    // Prefix and head in one piece: most messages are then one packet.
    struct sb_text text = {0};
    sb_text_add_n(&text, (const char *)prefix, PREFIX);
    sb_text_add_n(&text, head, length);
    free(head);
    enum sb_frame_end end = write_all(fd, text.data, text.length, deadline);
    sb_text_free(&text);
    if (end == SB_FRAME_OK)
        end = write_all(fd, frame->payload, frame->size, deadline);
    return end;
}

// *got: bytes that came, for SB_FRAME_CLOSED in the midst of a message.
static enum sb_frame_end read_all(int fd, void *data, size_t size, int64_t deadline,
                                  size_t *got)
{
    *got = 0;
    while (*got < size) {
        if (!wait_for(fd, POLLIN, deadline))
            return SB_FRAME_LATE;
        const ssize_t done = read(fd, (char *)data + *got, size - *got);
        if (done == 0 || (done < 0 && errno != EINTR && errno != EAGAIN))
            return SB_FRAME_CLOSED;
        if (done > 0)
            *got += (size_t)done;
    }
    return SB_FRAME_OK;
}

static enum sb_frame_end garbage(const unsigned char *bytes, size_t count,
                                 struct sb_error *err)
{
    char shown[PREFIX + 1];
    for (size_t i = 0; i < count; i++)
        shown[i] = bytes[i] >= 32 && bytes[i] < 127 ? (char)bytes[i] : '?';
    shown[count] = '\0';
    sb_fail(err, SB_WORKER_GARBAGE,
            "wrote \"%s\", which begins no message of the worker protocol", shown);
    return SB_FRAME_GARBAGE;
}

enum sb_frame_end sb_frame_read(int fd, struct sb_frame *frame, int64_t deadline,
                                struct sb_error *err)
{
    unsigned char prefix[PREFIX];
    size_t got;
    struct sb_frame read = {0};
    char *head = NULL;
    enum sb_frame_end end = read_all(fd, prefix, PREFIX, deadline, &got);
    // Bytes that are no beginning of a message are told as such, however few they are.
    if (got > 0 && memcmp(prefix, magic, got < 4 ? got : 4) != 0)
        return garbage(prefix, got, err);
    if (end != SB_FRAME_OK)
        return end;
    const uint64_t length = get_little(prefix + 4, 4), size = get_little(prefix + 8, 8);
    if (length > SB_FRAME_HEAD_LIMIT || size > SB_FRAME_PAYLOAD_LIMIT)
        return garbage(prefix, PREFIX, err);
    head = malloc(length + 1);
    read.payload = malloc(size + 1);
    read.size = size;
    end = SB_FRAME_GARBAGE;
    if (!head || !read.payload) {
        sb_fail(err, SB_WORKER_GARBAGE, "announced a message too large for this machine");
        goto done;
    }
    end = read_all(fd, head, length, deadline, &got);
    if (end == SB_FRAME_OK)
        end = read_all(fd, read.payload, size, deadline, &got);
    if (end != SB_FRAME_OK)
        goto done;
    read.head = json_loadb(head, length, JSON_REJECT_DUPLICATES, NULL);
    if (!json_is_object(read.head)) {
        sb_fail(err, SB_WORKER_GARBAGE, "wrote a message whose head is no JSON object");
        end = SB_FRAME_GARBAGE;
        goto done;
    }
    *frame = read;
    read = (struct sb_frame){0};

done:
    free(head);
    sb_frame_free(&read);
    return end;
}
