#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "stats/change_points.h"

struct sb_change_rule sb_change_rule_default(void)
{
    return (struct sb_change_rule){.min_length = 5, .min_magnitude = 0.02};
}

int sb_segments_max(int n, const struct sb_change_rule *rule)
{
    const int most = n / rule->min_length;
    return most > 1 ? most : 1;
}

int sb_change_points_room(int n)
{
    return 4 * n + 1;
}

// --- the least penalised deviation --------------------------------------------------------

// Some of the values, sorted, and the sum of their distances from their median.
struct crowd {
    double *sorted;
    int n;
    double deviation;
};

// The new value adds its distance from the median, or from the nearer of the middle two: the
// others lie as many on either side of the new median as of the old.
static void join(struct crowd *crowd, double y)
{
    double *sorted = crowd->sorted;
    const int n = crowd->n;
    int lo = 0, hi = n;
    while (lo < hi) {
        const int middle = lo + (hi - lo) / 2;
        if (sorted[middle] <= y)
            lo = middle + 1;
        else
            hi = middle;
    }
    if (n > 0)
        crowd->deviation += fmax(0, fmax(sorted[(n - 1) / 2] - y, y - sorted[n / 2]));
    memmove(sorted + lo + 1, sorted + lo, (size_t)(n - lo) * sizeof *sorted);
    sorted[lo] = y;
    crowd->n++;
}

// best[end]: the least for the first `end` values. start[end - 1]: of the last segment of that,
// or 0 where they are too few for a segment.
static void divide(const double *y, int n, int min_length, double penalty, double *sorted,
                   double *best, double *start)
{
    best[0] = 0;
    for (int end = 1; end <= n; end++) {
        struct crowd crowd = {sorted, 0, 0};
        best[end] = INFINITY;
        start[end - 1] = 0;
        for (int begin = end - 1; begin >= 0; begin--) {
            join(&crowd, y[begin]);
            if (end - begin < min_length)
                continue;
            const double sum = best[begin] + crowd.deviation + penalty;
            if (sum < best[end]) {
                best[end] = sum;
                start[end - 1] = begin;
            }
        }
    }
}

// Of the noise between neighbours: of one value it would be about the median deviation.
static double noise_of(const double *y, int n, double *scratch)
{
    for (int i = 1; i < n; i++)
        scratch[i - 1] = fabs(y[i] - y[i - 1]);
    sb_sort_doubles(scratch, n - 1);
    return n > 1 ? sb_median(scratch, n - 1) / sqrt(2) : 0;
}

// --- levels -------------------------------------------------------------------------------

static void take_level(const double *values, double *scratch, struct sb_segment *segment)
{
    memcpy(scratch, values + segment->start, (size_t)segment->n * sizeof *values);
    sb_sort_doubles(scratch, segment->n);
    segment->level = sb_median_interval(scratch, segment->n, 0.95);
}

static double step_between(const struct sb_segment *a, const struct sb_segment *b)
{
    return b->level.point / a->level.point;
}

// Joins the neighbours that differ least, if by less than the magnitude.
static bool join_least(const double *values, double magnitude, double *scratch,
                       struct sb_segment *segment, int *count)
{
    int least = -1;
    double distance = INFINITY;
    for (int s = 1; s < *count; s++) {
        const double step = step_between(&segment[s - 1], &segment[s]);
        // As far down as up: 0.8 and 1.25 are one distance.
        if (fabs(log(step)) < distance) {
            distance = fabs(log(step));
            least = s;
        }
    }
    if (least < 0 || distance >= log1p(magnitude))
        return false;
    segment[least - 1].n += segment[least].n;
    take_level(values, scratch, &segment[least - 1]);
    (*count)--;
    memmove(segment + least, segment + least + 1,
            (size_t)(*count - least) * sizeof *segment);
    return true;
}

// From the last segment back, then in order.
static int list_segments(const double *start, int n, struct sb_segment *segment)
{
    int count = 0;
    for (int end = n; end > 0; end = (int)start[end - 1])
        count++;
    for (int end = n, s = count - 1; end > 0; end = (int)start[end - 1], s--) {
        segment[s].start = (int)start[end - 1];
        segment[s].n = end - segment[s].start;
    }
    return count;
}

int sb_change_points(const double *values, int n, const struct sb_change_rule *rule,
                     double *scratch, struct sb_segment *segment)
{
    double *y = scratch, *sorted = y + n, *start = sorted + n, *best = start + n;
    if (n < 1 || n > SB_CHANGE_VALUES_MAX)
        return 0;
    for (int i = 0; i < n; i++) {
        if (!(values[i] > 0 && isfinite(values[i])))
            return 0;
        y[i] = log(values[i]);
    }
    const double noise = noise_of(y, n, sorted);
    // Without noise every step counts, but for those of rounding.
    const double penalty = fmax(2 * noise * (log(n) + 2), 1e-12);
    divide(y, n, rule->min_length, penalty, sorted, best, start);
    int count = list_segments(start, n, segment);
    for (int s = 0; s < count; s++)
        take_level(values, scratch, &segment[s]);
    while (join_least(values, rule->min_magnitude, scratch, segment, &count))
        ;
    for (int s = 0; s < count; s++) {
        segment[s].step = s > 0 ? step_between(&segment[s - 1], &segment[s]) : 1;
        segment[s].since_first = step_between(&segment[0], &segment[s]);
    }
    return count;
}
