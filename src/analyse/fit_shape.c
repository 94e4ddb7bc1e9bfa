// One type of light: which shape its counts have, and what it says of other counts.
#include <math.h>
#include <stdlib.h>

#include "analyse/fit.h"

const char *const sb_fit_shape_words[SB_FIT_SHAPE_COUNT] = {
    [SB_FIT_LINE] = "line",
    [SB_FIT_BEND] = "flat, then a line",
    [SB_FIT_UNEVEN] = "uneven",
};

static const double level_of_intervals = 0.95;
static const double steep_gap = 1.25;

// The ends of a row's interval; the median itself where it has none.
static double low_end(const struct sb_row *row)
{
    return isnan(row->ci_lo_ms) ? row->median_ms : row->ci_lo_ms;
}

static double high_end(const struct sb_row *row)
{
    return isnan(row->ci_hi_ms) ? row->median_ms : row->ci_hi_ms;
}

static double curve_at(const struct sb_fit_curve *curve, double n)
{
    return curve->level + curve->slope * fmax(n - curve->at, 0);
}

// The largest share by which a row misses the curve, and its count. Rows that have the curve in
// their interval miss nothing where `only_outside`.
static double farthest(const struct sb_fit_type *type, const struct sb_fit_curve *curve,
                       bool only_outside, double *n)
{
    double most = 0;
    *n = type->count[0].n;
    for (int i = 0; i < type->counts; i++) {
        const struct sb_row *row = type->count[i].row;
        const double ms = curve_at(curve, type->count[i].n);
        const double off = row->median_ms / ms - 1;
        if (only_outside && low_end(row) <= ms && ms <= high_end(row))
            continue;
        if (!(fabs(off) <= fabs(most))) {
            most = off;
            *n = type->count[i].n;
        }
    }
    return most;
}

// What the fits work on: counts from the break on, and three times of each.
struct points {
    double *x, *y, *lo, *hi, *scratch;
    int n;
};

static void points_make(struct points *points, const struct sb_fit_type *type)
{
    const size_t n = (size_t)type->counts;
    points->n = type->counts;
    points->x = sb_alloc((4 * n + (size_t)sb_theil_sen_room(type->counts) + n) *
                         sizeof *points->x);
    points->y = points->x + n;
    points->lo = points->y + n;
    points->hi = points->lo + n;
    points->scratch = points->hi + n;
    for (int i = 0; i < type->counts; i++) {
        points->x[i] = type->count[i].n;
        points->y[i] = type->count[i].row->median_ms;
        points->lo[i] = low_end(type->count[i].row);
        points->hi[i] = high_end(type->count[i].row);
    }
}

static void add_bound(struct sb_fit_type *type, double level, double slope)
{
    if (isfinite(slope) && isfinite(level))
        type->bound[type->bounds++] = (struct sb_fit_curve){level, slope, type->curve.at};
}

// The bounds of the curve; its break is taken as it is. The slope's interval comes from the
// counts behind the break alone, levels from all.
static void find_bounds(struct sb_fit_type *type, struct points *points)
{
    const double at = type->curve.at;
    const int n = points->n;
    int flat = 0;
    while (at > 0 && flat < n - 1 && points->x[flat + 1] <= at)
        flat++;
    for (int i = 0; i < n; i++)
        points->x[i] = fmax(points->x[i] - at, 0);
    double *x = points->x, *scratch = points->scratch;
    const struct sb_line line =
        sb_theil_sen(x + flat, points->y + flat, n - flat, level_of_intervals, scratch);
    const struct sb_line low =
        sb_theil_sen(x + flat, points->lo + flat, n - flat, level_of_intervals, scratch);
    const struct sb_line high =
        sb_theil_sen(x + flat, points->hi + flat, n - flat, level_of_intervals, scratch);
    type->bounds = 0;
    if (type->shape == SB_FIT_BEND)
        type->price = (struct sb_interval){type->curve.slope, line.slope.lo,
                                           line.slope.hi, line.slope.n};
    const double slope[] = {line.slope.lo, line.slope.hi, low.slope.point,
                            high.slope.point};
    const double *const y[] = {points->y, points->y, points->lo, points->hi};
    for (int i = 0; i < 4; i++)
        add_bound(type,
                  isnan(slope[i]) ? NAN : sb_line_level(x, y[i], n, slope[i], scratch),
                  slope[i]);
}

// Half the widths of two rows' intervals: a smaller difference is noise.
static double noise_of(const struct sb_row *a, const struct sb_row *b)
{
    return (high_end(a) - low_end(a) + high_end(b) - low_end(b)) / 2;
}

// Of the gaps between counts the one in which a light costs most, if it stands out.
static void find_jump(struct sb_fit_type *type, double *slope)
{
    int steepest = 0;
    for (int i = 0; i + 1 < type->counts; i++) {
        const struct sb_fit_count *a = &type->count[i], *b = &type->count[i + 1];
        slope[i] = (b->row->median_ms - a->row->median_ms) / (b->n - a->n);
        if (slope[i] > slope[steepest])
            steepest = i;
    }
    const double most = slope[steepest];
    const struct sb_fit_count *from = &type->count[steepest], *to = from + 1;
    sb_sort_doubles(slope, type->counts - 1);
    const double usual = sb_median(slope, type->counts - 1);
    const double jump = (most - usual) * (to->n - from->n);
    if (!(usual > 0) || !(most > steep_gap * usual) ||
        !(jump > noise_of(from->row, to->row)))
        return;
    type->jump_from = from->n;
    type->jump_to = to->n;
    type->jump_ms = jump;
}

void sb_fit_shape_type(struct sb_fit_type *type)
{
    struct points points;
    struct sb_bend bend;
    double ignored;
    points_make(&points, type);
    type->line =
        sb_theil_sen(points.x, points.y, points.n, level_of_intervals, points.scratch);
    const struct sb_fit_curve line = {type->line.intercept, type->line.slope.point, 0};
    type->off = farthest(type, &line, false, &type->off_n);
    type->shape = SB_FIT_UNEVEN;
    type->curve = line;
    type->price = type->line.slope;
    if (fabs(farthest(type, &line, true, &ignored)) <= SB_FIT_STRAIGHT)
        type->shape = SB_FIT_LINE;
    if (sb_bend_fit(points.x, points.y, points.n, points.scratch, &bend) &&
        sb_bend_is_clear(&bend, points.x, points.y, points.n, points.scratch)) {
        const struct sb_fit_curve bent = {bend.level, bend.slope, bend.at};
        if (fabs(farthest(type, &bent, true, &ignored)) <= SB_FIT_STRAIGHT) {
            type->shape = SB_FIT_BEND;
            type->curve = bent;
        }
    }
    if (type->shape == SB_FIT_UNEVEN)
        find_jump(type, points.scratch);
    else
        find_bounds(type, &points);
    free(points.x);
}

static double between(double a, double b, double share)
{
    return a + share * (b - a);
}

static struct sb_interval interpolate(const struct sb_fit_type *type, double n)
{
    int i = 0;
    while (i + 2 < type->counts && type->count[i + 1].n < n)
        i++;
    const struct sb_fit_count *a = &type->count[i], *b = &type->count[i + 1];
    const double share = (n - a->n) / (b->n - a->n);
    struct sb_interval at = {
        between(a->row->median_ms, b->row->median_ms, share),
        between(low_end(a->row), low_end(b->row), share),
        between(high_end(a->row), high_end(b->row), share),
        type->counts,
    };
    if (type->jump_ms > 0 && a->n == type->jump_from && n > a->n && n < b->n) {
        at.lo -= share * type->jump_ms;
        at.hi += (1 - share) * type->jump_ms;
    }
    return at;
}

struct sb_interval sb_fit_at(const struct sb_fit_type *type, double n)
{
    if (!(n >= type->count[0].n) || !(n <= type->count[type->counts - 1].n))
        return (struct sb_interval){NAN, NAN, NAN, 0};
    if (type->shape == SB_FIT_UNEVEN)
        return interpolate(type, n);
    const double point = curve_at(&type->curve, n);
    struct sb_interval at = {point, point, point, type->counts};
    for (int i = 0; i < type->bounds; i++) {
        at.lo = fmin(at.lo, curve_at(&type->bound[i], n));
        at.hi = fmax(at.hi, curve_at(&type->bound[i], n));
    }
    return at;
}

static double end_of(const struct sb_interval *interval, int side)
{
    return side < 0 ? interval->hi : side > 0 ? interval->lo : interval->point;
}

struct sb_fit_lights sb_fit_lights_in(const struct sb_fit_group *group,
                                      const struct sb_fit_type *type, double ms, int side)
{
    const int least = (int)type->count[0].n, most = (int)type->count[type->counts - 1].n;
    struct sb_fit_lights lights = {0};
    if (group->base) {
        const struct sb_interval floor = {group->base->median_ms, low_end(group->base),
                                          high_end(group->base), 1};
        lights.floor = end_of(&floor, side) > ms;
    }
    int fit = least - 1;
    for (int n = least; n <= most; n++) {
        const struct sb_interval at = sb_fit_at(type, n);
        if (!(end_of(&at, side) <= ms))
            break;
        fit = n;
    }
    // Few that fit prove that the floor does, whatever the scatter of its own row.
    lights.floor &= fit < least;
    lights.above = fit == most;
    lights.below = fit < least && least > 1 && !lights.floor;
    lights.n = lights.floor ? 0 : lights.below ? least : fit;
    return lights;
}
