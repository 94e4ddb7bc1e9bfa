#include "cases/judge.h"

#include <math.h>

#include "measure/explain.h"

// --- values -------------------------------------------------------------------------------

// Channels behind the places of a page (job.h, enum sb_probe_page).
enum { NONFINITE = 8, NEGATIVE, DECISIONS, VIEW = 6, NORMAL = 9, REACHED = 11 };

struct place { // of a value
    int of, point, light, component;
};

static int components_of(int of)
{
    return of >= 0 ? sb_term_rows[of].components : 3;
}

static double told_at(const struct sb_judged *judged, struct place at)
{
    const struct sb_unit_told *told = judged->told;
    switch (at.of) {
    case SB_OF_COLOUR: // per vertex: what it hands on, diffuse and specular, added
        return sb_told_colour(told, at.point)[at.component] +
               (judged->setting->vertex
                    ? sb_told_page(&told->frame, at.point)[at.component]
                    : 0);
    case SB_OF_NORMAL:
        return sb_told_page(&told->frame, at.point)[NORMAL + at.component];
    case SB_OF_VIEW:
        return sb_told_page(&told->frame, at.point)[VIEW + at.component];
    default:
        return sb_told_page(&told->light[at.light],
                            at.point)[sb_term_rows[at.of].place + at.component];
    }
}

static double right_at(const struct sb_judged *judged, struct place at)
{
    const struct sb_points_truth *truth = judged->truth;
    const struct sb_ref_shade *shade = &truth->shade[at.point];
    const struct sb_ref_terms *terms =
        &truth->terms[(size_t)at.point * (size_t)judged->points->lights +
                      (size_t)at.light];
    struct sb_vec3 v = truth->colour[at.point];
    if (at.of >= 0)
        return ((const double *)((const char *)terms +
                                 sb_term_rows[at.of].offset))[at.component];
    if (at.of == SB_OF_NORMAL)
        v = shade->normal;
    if (at.of == SB_OF_VIEW)
        v = shade->view;
    return at.component == 0 ? v.x : at.component == 1 ? v.y : v.z;
}

// --- decisions ----------------------------------------------------------------------------

// How near, in cosines, a branch may be for rounding to take it the other way.
static double decision_bound(const struct sb_judged *judged)
{
    return sb_case_precisions[judged->setting->precision].half ? 0x1p-6 : 1e-5;
}

static bool is_flipped(const struct sb_judged *judged, int point)
{
    const double told = sb_told_page(&judged->told->inputs, point)[DECISIONS];
    return told != (double)judged->truth->shade[point].decisions;
}

static bool is_left_out(const struct sb_judged *judged, int point)
{
    return is_flipped(judged, point) &&
           judged->truth->shade[point].margin <= decision_bound(judged);
}

// --- figures of one point -----------------------------------------------------------------

static double count_bad(const struct sb_judged *judged, int point)
{
    const float *page = sb_told_page(&judged->told->inputs, point);
    double bad = page[NONFINITE] + page[NEGATIVE];
    for (int c = 0; c < 3; c++) {
        const double value = told_at(judged, (struct place){SB_OF_COLOUR, point, 0, c});
        bad += !(isfinite(value) && value >= 0);
    }
    return bad;
}

static double error_at(const struct sb_judged *judged, enum sb_figure figure,
                       struct place at)
{
    const double told = told_at(judged, at), right = right_at(judged, at);
    const double error = fabs(told - right);
    if (figure == SB_FIGURE_LEAKS)
        return right != 0 ? 0 : isfinite(told) ? 255 * fabs(told) : INFINITY;
    if (figure == SB_FIGURE_EXCESS)
        return isfinite(told) ? 255 * fmax(told - 1, 0) : INFINITY;
    if (!isfinite(error)) // both infinite is wrong, too: nothing right is infinite
        return INFINITY;
    if (figure == SB_FIGURE_RELATIVE)
        return error == 0 ? 0 : error / fabs(right);
    return 255 * error / (judged->it->hdr ? fmax(fabs(right), 1) : 1);
}

static struct sb_vec3 vector_at(const struct sb_judged *judged,
                                double (*value)(const struct sb_judged *, struct place),
                                struct place at)
{
    double v[3];
    for (at.component = 0; at.component < 3; at.component++)
        v[at.component] = value(judged, at);
    return (struct sb_vec3){v[0], v[1], v[2]};
}

// By the tangent: a cosine near 1 has lost the angle. A zero vector is right where the right one is
// zero, and as wrong as can be elsewhere.
static double angle_at(const struct sb_judged *judged, struct place at)
{
    const struct sb_vec3 a = vector_at(judged, told_at, at);
    const struct sb_vec3 b = vector_at(judged, right_at, at);
    const double length = sb_vec3_dot(a, a), wanted = sb_vec3_dot(b, b);
    if (!isfinite(length) || !isfinite(wanted))
        return INFINITY;
    if (length == 0 || wanted == 0)
        return length == wanted ? 0 : 180;
    return 180 / SB_PI * atan2(sb_vec3_length(sb_vec3_cross(a, b)), sb_vec3_dot(a, b));
}

static double worst_of_point(const struct sb_judged *judged,
                             const struct sb_criterion *criterion, int point)
{
    const int lights = criterion->of >= 0 ? judged->told->lights : 1;
    double worst = 0;
    for (int i = 0; i < lights; i++) {
        struct place at = {criterion->of, point, i, 0};
        if (criterion->figure == SB_FIGURE_ANGLE) {
            worst = fmax(worst, angle_at(judged, at));
            continue;
        }
        for (; at.component < components_of(at.of); at.component++)
            worst = fmax(worst, error_at(judged, criterion->figure, at));
    }
    return worst;
}

// --- figures of all points ----------------------------------------------------------------

static double count_all(const struct sb_judged *judged, enum sb_figure figure, int *point)
{
    double sum = 0;
    for (int p = 0; p < judged->points->count; p++) {
        const double one =
            figure == SB_FIGURE_FINITE ? count_bad(judged, p) : is_flipped(judged, p);
        if (one > 0 && *point < 0)
            *point = p;
        sum += one;
    }
    return figure == SB_FIGURE_FINITE ? sum : 100 * sum / fmax(judged->points->count, 1);
}

static double count_rises(const struct sb_judged *judged, int of, int *point)
{
    double rises = 0;
    for (int p = 1; p < judged->points->count; p++) {
        const double before = told_at(judged, (struct place){of, p - 1, 0, 0});
        const double after = told_at(judged, (struct place){of, p, 0, 0});
        if (after <= before)
            continue;
        rises++; // a NaN too
        if (*point < 0)
            *point = p;
    }
    return rises;
}

double sb_judge_point(const struct sb_judged *judged,
                      const struct sb_criterion *criterion, int point)
{
    if (criterion->figure == SB_FIGURE_FINITE)
        return count_bad(judged, point);
    return is_left_out(judged, point) ? 0 : worst_of_point(judged, criterion, point);
}

double sb_judge(const struct sb_judged *judged, const struct sb_criterion *criterion,
                int *point)
{
    double worst = 0;
    *point = -1;
    if (criterion->figure == SB_FIGURE_FINITE || criterion->figure == SB_FIGURE_FLIPS)
        return count_all(judged, criterion->figure, point);
    if (criterion->figure == SB_FIGURE_RISES)
        return count_rises(judged, criterion->of, point);
    for (int p = 0; p < judged->points->count; p++) {
        const double one = sb_judge_point(judged, criterion, p);
        if (!(one <= worst)) { // a NaN too
            worst = isnan(one) ? INFINITY : one;
            *point = p;
        }
    }
    return worst;
}

double sb_criterion_bound(const struct sb_criterion *criterion,
                          enum sb_case_precision precision)
{
    return sb_case_precisions[precision].half ? criterion->half : criterion->highp;
}

// How near to failing: above 1 it fails.
static double strain_of(double measured, double bound)
{
    if (measured <= bound)
        return bound > 0 ? measured / bound : 0;
    return bound > 0 && !isnan(measured) ? measured / bound : INFINITY;
}

void sb_judge_all(const struct sb_judged *judged, struct sb_outcome *outcome)
{
    double strain = -1;
    outcome->verdict = SB_VERDICT_NA;
    for (int i = 0; i < SB_CRITERION_MAX; i++) {
        const struct sb_criterion *criterion = &judged->it->criterion[i];
        const double bound = sb_criterion_bound(criterion, judged->setting->precision);
        if (criterion->figure == SB_FIGURE_NONE || isnan(bound))
            continue;
        int point;
        const double measured = sb_judge(judged, criterion, &point);
        const double now = strain_of(measured, bound);
        if (now <= strain)
            continue;
        strain = now;
        outcome->verdict = now > 1 ? SB_VERDICT_FAIL : SB_VERDICT_PASS;
        outcome->figure = criterion->figure;
        outcome->of = criterion->of;
        outcome->measured = measured;
        outcome->bound = bound;
        outcome->point = point;
        if (now > 1)
            return;
    }
}
