#include "gl/timer.h"

#include "base/clock.h"

void sb_query_make(struct sb_query *query)
{
    glGenQueries(2, query->name);
}

void sb_query_free(struct sb_query *query)
{
    glDeleteQueries(2, query->name);
    *query = (struct sb_query){0};
}

// Reading GL_GPU_DISJOINT_EXT clears it, and it speaks of the results read before it
// (EXT_disjoint_timer_query): so it is asked after each.
static enum sb_read check_disjoint(const struct sb_caps *caps)
{
    GLint disjoint = GL_FALSE;
    if (caps->disjoint)
        glGetIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);
    return disjoint ? SB_READ_DISJOINT : SB_READ_OK;
}

static bool available(GLuint query)
{
    GLuint result = GL_FALSE;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &result);
    return result;
}

static int elapsed_bits(const struct sb_caps *caps)
{
    return (int)caps->elapsed_bits;
}

static bool has_elapsed(const struct sb_caps *caps)
{
    return caps->elapsed_bits > 0;
}

static void elapsed_begin(struct sb_query *query)
{
    glBeginQuery(GL_TIME_ELAPSED, query->name[0]);
}

static void elapsed_end(struct sb_query *query)
{
    (void)query;
    glEndQuery(GL_TIME_ELAPSED);
}

static enum sb_read elapsed_read(struct sb_query *query, const struct sb_caps *caps,
                                 int64_t *ns)
{
    if (!available(query->name[0]))
        return SB_READ_LATER;
    GLuint64 result = 0;
    glGetQueryObjectui64v(query->name[0], GL_QUERY_RESULT, &result);
    *ns = (int64_t)result;
    return check_disjoint(caps);
}

// A tiler that writes the counter tile by tile reports its last tile, and one that leaves it
// to a thread of its own may write the begin after work has begun: on llvmpipe glFlush alone
// lets the vertex work win that race now and then. So the begin is waited for, and the end
// comes after a flush, as work of its own.
static void finished_begin(struct sb_query *query)
{
    glBeginQuery(GL_TIME_ELAPSED, query->name[0]);
    glFinish();
}

static void flushed_end(struct sb_query *query)
{
    (void)query;
    glFlush();
    glEndQuery(GL_TIME_ELAPSED);
}

static int timestamp_bits(const struct sb_caps *caps)
{
    return (int)caps->timestamp_bits;
}

static bool has_timestamp(const struct sb_caps *caps)
{
    return caps->timestamp_bits > 0;
}

static void timestamp_begin(struct sb_query *query)
{
    glQueryCounter(query->name[0], GL_TIMESTAMP);
    glFinish();
}

static void timestamp_end(struct sb_query *query)
{
    glFlush();
    glQueryCounter(query->name[1], GL_TIMESTAMP);
}

static enum sb_read timestamp_read(struct sb_query *query, const struct sb_caps *caps,
                                   int64_t *ns)
{
    if (!available(query->name[0]) || !available(query->name[1]))
        return SB_READ_LATER;
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(query->name[0], GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(query->name[1], GL_QUERY_RESULT, &end);
    // A counter of 36 bits wraps after 69 s: the difference is taken modulo its size.
    const int bits = timestamp_bits(caps);
    const GLuint64 mask = bits >= 64 ? ~UINT64_C(0) : (UINT64_C(1) << bits) - 1;
    *ns = (int64_t)((end - begin) & mask);
    return check_disjoint(caps);
}

static bool always(const struct sb_caps *caps)
{
    (void)caps;
    return true;
}

static int no_bits(const struct sb_caps *caps)
{
    (void)caps;
    return 0;
}

static void nothing(struct sb_query *query)
{
    (void)query;
}

static enum sb_read no_time(struct sb_query *query, const struct sb_caps *caps,
                            int64_t *ns)
{
    (void)query, (void)caps;
    *ns = SB_NO_TIME;
    return SB_READ_OK;
}

static const struct sb_timer_fns elapsed = {
    .name = "elapsed",
    .help = "GL_TIME_ELAPSED around the batch",
    .usable = has_elapsed,
    .bits = elapsed_bits,
    .begin = elapsed_begin,
    .end = elapsed_end,
    .read = elapsed_read,
};

static const struct sb_timer_fns elapsed_finish = {
    .name = "elapsed+finish",
    .help = "GL_TIME_ELAPSED; glFinish after its begin, glFlush before its end",
    .usable = has_elapsed,
    .bits = elapsed_bits,
    .begin = finished_begin,
    .end = flushed_end,
    .read = elapsed_read,
};

static const struct sb_timer_fns timestamp_finish = {
    .name = "timestamp+finish",
    .help = "two GL_TIMESTAMP; glFinish after the first, glFlush before the second",
    .usable = has_timestamp,
    .bits = timestamp_bits,
    .begin = timestamp_begin,
    .end = timestamp_end,
    .read = timestamp_read,
};

static const struct sb_timer_fns wall = {
    .name = "wall",
    .help = "no query: the monotonic clock until the batch was drained",
    .usable = always,
    .bits = no_bits,
    .begin = nothing,
    .end = nothing,
    .read = no_time,
};

const struct sb_timer_fns *const sb_timers[] = {
    &elapsed, &elapsed_finish, &timestamp_finish, &wall, NULL,
};

enum sb_read sb_timer_read(const struct sb_timer_fns *timer, struct sb_query *query,
                           const struct sb_caps *caps, int64_t *ns)
{
    const int64_t deadline = sb_clock_ns() + 1000000000;
    enum sb_read read;
    while ((read = timer->read(query, caps, ns)) == SB_READ_LATER &&
           sb_clock_ns() < deadline)
        sb_sleep_ns(100000);
    return read;
}
