#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "stats/audit.h"
#include "stats/order.h"

// The clauses of sb_audit_judge's contract, where these numbers are explained.
static const int64_t long_batch_ns = 2000000, long_frame_ns = 1000000;
static const double least_of_drained = 0.8, most_of_doubled = 1.25;
static const double least_of_doubled[SB_LOAD_COUNT] = {
    [SB_LOAD_FRAGMENT] = 0.8,
    [SB_LOAD_VERTEX] = 0.7,
};

static const char *const load_names[SB_LOAD_COUNT] = {
    [SB_LOAD_FRAGMENT] = "fragment",
    [SB_LOAD_VERTEX] = "vertex",
};

static bool refuse(struct sb_timer_source *source, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool refuse(struct sb_timer_source *source, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(source->reason, sizeof source->reason, format, args);
    va_end(args);
    return false;
}

// For "%s" at the start of a reason.
static const char *place(const struct sb_timer_reading *at, char text[static 64])
{
    snprintf(text, 64, "%s load, %d x %d, %d frame%s", load_names[at->load], at->size,
             at->size, at->frames, at->frames == 1 ? "" : "s");
    return text;
}

// Quantities of one reading; NAN where the contract says it tells nothing.

static double query(const struct sb_timer_reading *r)
{
    return (double)r->query_ns;
}

static double long_query(const struct sb_timer_reading *r)
{
    return r->wall_ns >= long_batch_ns ? (double)r->query_ns : NAN;
}

static double query_over_wall(const struct sb_timer_reading *r)
{
    return long_query(r) / (double)(r->wall_ns - r->wait_ns);
}

static bool tells_of_draining(const struct sb_timer_reading *r)
{
    return r->frames >= 2 && r->drained_ns >= long_frame_ns * r->frames;
}

static double batch_wall(const struct sb_timer_reading *r)
{
    return tells_of_draining(r) ? (double)r->wall_ns : NAN;
}

static double drained_wall(const struct sb_timer_reading *r)
{
    return tells_of_draining(r) ? (double)r->drained_ns : NAN;
}

// The values of a quantity over the repeats of a reading, or of the same load in batches of
// another length; returns how many there are.
static int values_of(const struct sb_audit *audit, const struct sb_timer_reading *like,
                     int frames, double (*quantity)(const struct sb_timer_reading *),
                     double values[static SB_READING_MAX])
{
    int n = 0;
    for (int i = 0; i < audit->reading_count; i++) {
        const struct sb_timer_reading *r = &audit->reading[i];
        if (r->source != like->source || r->load != like->load || r->size != like->size ||
            r->frames != frames || r->disjoint)
            continue;
        const double value = quantity(r);
        if (!isnan(value))
            values[n++] = value;
    }
    sb_sort_doubles(values, n);
    return n;
}

static double median_of(const struct sb_audit *audit, const struct sb_timer_reading *like,
                        int frames, double (*quantity)(const struct sb_timer_reading *))
{
    double values[SB_READING_MAX];
    return sb_median(values, values_of(audit, like, frames, quantity, values));
}

// For times of different batches: another process can only make them longer, so the least
// of the repeats is nearest to the time of the batch alone. NAN where no repeat tells.
static double least_of(const struct sb_audit *audit, const struct sb_timer_reading *like,
                       int frames, double (*quantity)(const struct sb_timer_reading *))
{
    double values[SB_READING_MAX];
    return values_of(audit, like, frames, quantity, values) > 0 ? values[0] : NAN;
}

// The three ratios that are judged, each for the repeats of a reading.
typedef double ratio_fn(const struct sb_audit *audit, const struct sb_timer_reading *at);

static double wall_ratio(const struct sb_audit *audit, const struct sb_timer_reading *at)
{
    return median_of(audit, at, at->frames, query_over_wall);
}

static double drained_ratio(const struct sb_audit *audit,
                            const struct sb_timer_reading *at)
{
    return least_of(audit, at, at->frames, batch_wall) /
           least_of(audit, at, at->frames, drained_wall);
}

static double doubling_ratio(const struct sb_audit *audit,
                             const struct sb_timer_reading *at)
{
    return least_of(audit, at, 2 * at->frames, query) /
           (2 * least_of(audit, at, at->frames, long_query));
}

struct finding {
    bool judged;                       // there was a ratio at all
    const struct sb_timer_reading *at; // where it lies farthest outside; NULL: nowhere
    double ratio;                      // ... and what it is there
};

static struct finding outside(const struct sb_audit *audit, int source, enum sb_load load,
                              ratio_fn *ratio, double lo, double hi)
{
    struct finding finding = {0};
    for (int i = 0; i < audit->reading_count; i++) {
        const struct sb_timer_reading *r = &audit->reading[i];
        if (r->source != source || r->load != load)
            continue;
        const double value = ratio(audit, r);
        if (isnan(value))
            continue;
        finding.judged = true;
        if ((value < lo || value > hi) &&
            (!finding.at || fabs(value - 1) > fabs(finding.ratio - 1))) {
            finding.at = r;
            finding.ratio = value;
        }
    }
    return finding;
}

static bool judge_counter(struct sb_audit *audit, int s)
{
    struct sb_timer_source *source = &audit->source[s];
    int all = 0, disjoint = 0, absurd = 0;
    for (int i = 0; i < audit->reading_count; i++) {
        const struct sb_timer_reading *r = &audit->reading[i];
        if (r->source != s)
            continue;
        all++;
        if (r->disjoint) {
            disjoint++;
            continue;
        }
        if (source->bits == 0 && r->query_ns != r->wall_ns)
            return refuse(source, "its counter has 0 bits: the driver measures nothing");
        if (r->query_ns < 0)
            return refuse(source, "a reading is negative (%" PRId64 " ns)", r->query_ns);
        absurd += r->query_ns > 10 * r->wall_ns;
    }
    if (all == 0)
        return refuse(source, "no readings were taken");
    if (disjoint == all)
        return refuse(source, "all %d readings are disjoint", all);
    if (4 * absurd > all - disjoint)
        return refuse(source, "%d of %d readings are over ten times their wall time",
                      absurd, all - disjoint);
    return true;
}

static bool judge_samples(struct sb_audit *audit, int s)
{
    struct sb_timer_source *source = &audit->source[s];
    char text[64];
    for (int i = 0; i < audit->reading_count; i++) {
        const struct sb_timer_reading *r = &audit->reading[i];
        if (r->source != s || r->disjoint || r->samples < 0 || r->samples_one < 0)
            continue;
        if (r->samples_one == 0 && r->load == SB_LOAD_FRAGMENT)
            return refuse(source, "%s: no sample passed, nothing was drawn",
                          place(r, text));
        if (r->samples != r->frames * r->samples_one)
            return refuse(source, "%s: %" PRId64 " samples passed, not %d times %" PRId64,
                          place(r, text), r->samples, r->frames, r->samples_one);
    }
    return true;
}

static bool judge_wall(struct sb_audit *audit, int s, double lo, double hi)
{
    struct sb_timer_source *source = &audit->source[s];
    char text[64];
    for (enum sb_load load = 0; load < SB_LOAD_COUNT; load++) {
        const struct finding bad = outside(audit, s, load, wall_ratio, lo, hi);
        if (!bad.judged)
            return refuse(source, "no batch of the %s load took 2 ms, enough to judge by",
                          load_names[load]);
        if (bad.at && source->bits > 0)
            return refuse(source, "%s: it reads %.3f of the wall time, not %.2f to %.2f",
                          place(bad.at, text), bad.ratio, lo, hi);
    }
    return true;
}

static bool judge_drained(struct sb_audit *audit, int s)
{
    struct sb_timer_source *source = &audit->source[s];
    char text[64];
    const struct finding bad =
        outside(audit, s, SB_LOAD_FRAGMENT, drained_ratio, least_of_drained, INFINITY);
    if (!bad.judged)
        return refuse(source, "no batch of two frames or more of the fragment load has "
                              "frames of 1 ms, enough to show dropped draws");
    if (bad.at)
        return refuse(source,
                      "%s: a batch takes %.2f of the same frames drained one by one: "
                      "draws were dropped",
                      place(bad.at, text), bad.ratio);
    return true;
}

static bool judge_doubling(struct sb_audit *audit, int s)
{
    struct sb_timer_source *source = &audit->source[s];
    char text[64];
    for (enum sb_load load = 0; load < SB_LOAD_COUNT; load++) {
        const struct finding bad = outside(audit, s, load, doubling_ratio,
                                           least_of_doubled[load], most_of_doubled);
        if (bad.at)
            return refuse(source, "%s: twice the frames read as %.2f times the time",
                          place(bad.at, text), 2 * bad.ratio);
    }
    return true;
}

static double largest_error(const struct sb_audit *audit, int s)
{
    double error = NAN;
    for (int i = 0; i < audit->reading_count; i++)
        if (audit->reading[i].source == s)
            error = fmax(error, fabs(wall_ratio(audit, &audit->reading[i]) - 1));
    return error; // fmax passes over NAN
}

static double misread(const struct sb_timer_reading *r)
{
    return fabs((double)(r->wall_ns - r->wait_ns) - (double)r->query_ns);
}

static double most_misread(const struct sb_audit *audit, int s)
{
    double most = 0;
    for (int i = 0; i < audit->reading_count; i++) {
        const struct sb_timer_reading *r = &audit->reading[i];
        if (r->source == s && r->frames == 1)
            most = fmax(most, median_of(audit, r, 1, misread)); // passes over NAN
    }
    return most;
}

void sb_audit_judge(struct sb_audit *audit, double tolerance)
{
    const double lo = 1 - tolerance, hi = 1 + tolerance;
    audit->chosen = -1;
    for (int s = 0; s < audit->source_count; s++) {
        struct sb_timer_source *source = &audit->source[s];
        source->reason[0] = '\0';
        source->error = NAN;
        source->credible = false;
        if (!source->usable) {
            refuse(source, "not available in this context");
            continue;
        }
        source->error = largest_error(audit, s);
        source->missing_ns = most_misread(audit, s);
        // Dropped draws also break the doubling, and say more.
        source->credible = judge_counter(audit, s) && judge_samples(audit, s) &&
                           judge_wall(audit, s, lo, hi) && judge_drained(audit, s) &&
                           judge_doubling(audit, s);
        if (source->credible && audit->chosen < 0)
            audit->chosen = s;
    }
}
