#include "gl/audit.h"

#include <stdlib.h>

#include "base/clock.h"
#include "gl/load.h"
#include "gl/timer.h"

enum {
    REPETITIONS = 5,
    LOOPS_MAX = 1 << 20,
    SHORT_QUERIES = 64,
    FEW_QUERIES = 15,
    BATCHES_MAX = 4
};

// A timed frame takes 20 times what waiting for a frame costs (45 us on a software
// renderer, 250 us by way of a translating driver), so that a wait that was measured wrong
// by half stays inside the tolerance: 28 frames by every source, five times over, take two
// seconds at the shortest.
static const int64_t waits_per_frame = 20;
static const int64_t shortest_frame_ns = 2200000, longest_frame_ns = 10000000;

// A load whose cheapest frame takes so much more than wanted is left out: a renderer that
// slow would spend minutes on it, and has shown its timers on the smaller ones.
static const int64_t excess_ns = 6000000;

// Batches of 1, 2, 4 ... 2^(batches-1) frames.
static const struct plan {
    enum sb_load load;
    int size, batches;
} plans[] = {
    {SB_LOAD_FRAGMENT, 64, 2},
    {SB_LOAD_FRAGMENT, 256, 4},
    {SB_LOAD_FRAGMENT, 512, 2},
    {SB_LOAD_VERTEX, 64, 3},
};

struct bench {
    const struct sb_caps *caps;
    struct sb_audit *audit;
    struct sb_query query[SB_TIMER_MAX];
    int64_t frame_ns;        // how long a frame is to take
    int64_t wait_ns;         // what waiting for a batch costs by itself
    bool lost[SB_TIMER_MAX]; // sources whose query never arrived: not waited for again
};

static void time_batch(struct bench *bench, const struct sb_gl_load *load,
                       struct sb_timer_reading *reading)
{
    if (bench->lost[reading->source]) {
        reading->query_ns = -1; // the judge refuses the source for it
        return;
    }
    const struct sb_timer_fns *timer = sb_timers[reading->source];
    struct sb_query *query = &bench->query[reading->source];
    // The worst case for a tiler: a pass on the first frame's target is under way. With
    // another target it would begin a pass after the query, and time it right by luck.
    glBindFramebuffer(GL_FRAMEBUFFER, load->ring[0].framebuffer);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    sb_gl_drain();
    const int64_t start = sb_clock_ns();
    timer->begin(query);
    sb_gl_load_draw(load, reading->frames);
    timer->end(query);
    sb_gl_drain();
    reading->wall_ns = sb_clock_ns() - start;
    reading->wait_ns = bench->wait_ns;
    const enum sb_read read =
        sb_timer_read(timer, query, bench->caps, &reading->query_ns);
    reading->disjoint = read == SB_READ_DISJOINT;
    if (read == SB_READ_LATER)
        reading->query_ns = -1;
    else if (reading->query_ns == SB_NO_TIME)
        reading->query_ns = reading->wall_ns;
    bench->lost[reading->source] = read == SB_READ_LATER;
}

static int64_t time_drained(const struct sb_gl_load *load, int frames)
{
    int64_t sum = 0;
    for (int i = 0; i < frames; i++) {
        const int64_t start = sb_clock_ns();
        sb_gl_load_draw(load, 1);
        sb_gl_drain();
        sum += sb_clock_ns() - start;
    }
    return sum;
}

// Finds the number of loops that makes a frame take that long. Starts with the cheapest
// and grows by at most eight times: on an unknown device a long guess could hang the
// machine.
static int64_t calibrate(const struct sb_gl_load *load, int64_t frame_ns)
{
    for (int loops = 1;;) {
        sb_gl_load_set_loops(load, loops);
        const int64_t first = time_drained(load, 1), second = time_drained(load, 1);
        const int64_t ns = first < second ? first : second;
        if (ns >= frame_ns || loops >= LOOPS_MAX)
            return ns;
        const double factor = 1.05 * (double)frame_ns / (double)ns;
        loops = (int)((factor < 8 ? factor : 8) * loops) + 1;
    }
}

static int64_t count_samples(const struct bench *bench, const struct sb_gl_load *load,
                             int frames)
{
    if (!bench->caps->samples_passed)
        return -1;
    GLuint query, samples = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    sb_gl_load_draw(load, frames);
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
    glDeleteQueries(1, &query);
    return samples;
}

// One repetition: every batch length by one source, so that these are compared within a
// few milliseconds; then by the next, beginning with another source each time, so that
// noise hits all alike.
static void read_repetition(struct bench *bench, const struct sb_gl_load *load,
                            const struct sb_timer_reading *batches, int batch_count,
                            int repetition)
{
    struct sb_audit *audit = bench->audit;
    int64_t drained_ns[BATCHES_MAX];
    for (int k = 0; k < batch_count; k++)
        drained_ns[k] = time_drained(load, batches[k].frames);
    for (int i = 0; i < audit->source_count; i++) {
        const int source = (i + repetition) % audit->source_count;
        for (int k = 0; k < batch_count && audit->source[source].usable; k++) {
            struct sb_timer_reading *reading = &audit->reading[audit->reading_count++];
            *reading = batches[k];
            reading->source = source;
            reading->drained_ns = drained_ns[k];
            time_batch(bench, load, reading);
        }
    }
}

static bool read_plan(struct bench *bench, const struct plan *plan, struct sb_error *err)
{
    struct sb_gl_load load = {0};
    struct sb_timer_reading batches[BATCHES_MAX];
    const bool made = sb_gl_load_make(&load, plan->load, plan->size, bench->caps, err);
    if (made && calibrate(&load, bench->frame_ns) <= bench->frame_ns + excess_ns) {
        const int64_t samples_one = count_samples(bench, &load, 1);
        for (int k = 0; k < plan->batches; k++)
            batches[k] = (struct sb_timer_reading){
                .load = plan->load,
                .size = plan->size,
                .frames = 1 << k,
                .samples = count_samples(bench, &load, 1 << k),
                .samples_one = samples_one,
            };
        for (int i = 0; i < REPETITIONS; i++)
            read_repetition(bench, &load, batches, plan->batches, i);
    }
    sb_gl_load_free(&load);
    return made;
}

static int compare_ns(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

// `count` sorted readings of `frames` frames by one source.
static void read_sorted(struct bench *bench, const struct sb_gl_load *load, int source,
                        int frames, int64_t *ns, int count)
{
    struct sb_timer_reading reading = {.source = source, .frames = frames};
    for (int i = 0; i < count; i++) {
        time_batch(bench, load, &reading);
        ns[i] = reading.query_ns;
    }
    qsort(ns, (size_t)count, sizeof *ns, compare_ns);
}

static void read_resolution(struct bench *bench, const struct sb_gl_load *load,
                            int source)
{
    struct sb_timer_source *row = &bench->audit->source[source];
    int64_t ns[SHORT_QUERIES];
    // The first queries of a context may return anything (10^12 ns was seen): thrown
    // away.
    read_sorted(bench, load, source, 1, ns, 4);
    read_sorted(bench, load, source, 1, ns, SHORT_QUERIES);
    for (int i = 1; i < SHORT_QUERIES; i++) {
        const double step = (double)(ns[i] - ns[i - 1]);
        if (step > 0 && (row->granularity_ns == 0 || step < row->granularity_ns))
            row->granularity_ns = step;
    }
    read_sorted(bench, load, source, 0, ns, FEW_QUERIES);
    row->empty_ns = (double)ns[FEW_QUERIES / 2];
}

static int64_t cost_of_waiting(const struct sb_gl_load *load)
{
    int64_t ns[FEW_QUERIES];
    for (int i = 0; i < FEW_QUERIES; i++)
        ns[i] = time_drained(load, 1);
    qsort(ns, FEW_QUERIES, sizeof *ns, compare_ns);
    return ns[FEW_QUERIES / 2];
}

// With frames of 16 x 16 pixels, which cost next to nothing.
static bool read_resolutions(struct bench *bench, struct sb_error *err)
{
    struct sb_gl_load load = {0};
    const bool made = sb_gl_load_make(&load, SB_LOAD_FRAGMENT, 16, bench->caps, err);
    for (int i = 0; made && i < bench->audit->source_count; i++)
        if (bench->audit->source[i].usable)
            read_resolution(bench, &load, i);
    if (made) {
        bench->wait_ns = cost_of_waiting(&load);
        const int64_t ns = waits_per_frame * bench->wait_ns;
        bench->frame_ns = ns < shortest_frame_ns  ? shortest_frame_ns
                          : ns > longest_frame_ns ? longest_frame_ns
                                                  : ns;
    }
    sb_gl_load_free(&load);
    return made;
}

bool sb_gl_audit_read(const struct sb_caps *caps, struct sb_audit *audit,
                      struct sb_error *err)
{
    struct bench bench = {.caps = caps, .audit = audit};
    *audit = (struct sb_audit){.chosen = -1};
    for (int i = 0; sb_timers[i]; i++) {
        audit->source[audit->source_count++] = (struct sb_timer_source){
            .name = sb_timers[i]->name,
            .usable = sb_timers[i]->usable(caps),
            .bits = sb_timers[i]->bits(caps),
        };
        sb_query_make(&bench.query[i]);
    }
    bool ok = read_resolutions(&bench, err);
    for (size_t i = 0; ok && i < sizeof plans / sizeof *plans; i++)
        ok = read_plan(&bench, &plans[i], err);
    for (int i = 0; i < audit->source_count; i++)
        sb_query_free(&bench.query[i]);
    const char *error = sb_gl_error();
    if (ok && error)
        ok = sb_fail(err, SB_GL_ERROR, "%s during the timer audit", error);
    return ok;
}
