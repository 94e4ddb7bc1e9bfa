#include "cases/search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/mem.h"
#include "cases/judge.h"
#include "cases/knobs.h"

// One light, so that what is found is that light's. All laws, models, cones, shapes and maps.
static const char *const looks[] = {
    "point=1 attenuation=polynomial",
    "point=1 attenuation=radius model=phong",
    "point=1 attenuation=windowed fresnel=schlick",
    "point=1 attenuation=none maps=normal",
    "point=1 attenuation=none specular_norm=energy",
    "dir=1 model=phong specular_norm=energy",
    "spot=1 cone=hard attenuation=none",
    "spot=1 cone=exponent attenuation=none",
    "spot=1 cone=linear attenuation=none",
    "spot=1 cone=smooth attenuation=none",
    "area=1 area_shape=sphere",
    "area=1 area_shape=tube model=phong",
    "area=1 area_shape=box",
    "area=1 area_shape=capsule",
};
enum { LOOKS = sizeof looks / sizeof *looks };

enum {
    HERD = 1024,    // points of a generation
    PARENTS = 32,   // of which the next is bred
    JITTERS = 8,    // of every point, for its spread
    GENERATIONS = 6 // before another variant has its turn
};

static const struct sb_criterion not_finite = {SB_FIGURE_FINITE, 0, 0, 0};
static const struct sb_criterion wrong = {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, 4};

struct search {
    const struct sb_search_params *params;
    struct sb_findings *findings;
    struct sb_case it; // what the judge asks of
    struct sb_variant variant;
    struct sb_case_setting setting;
    struct sb_unit unit;
    struct sb_random random;
};

struct score {
    int point;
    double measured, spread;
    double value; // above 1: found
};

// --- scores -------------------------------------------------------------------------------

// Every float of a point and its light moved by one unit in the last place, or not, or back: of a
// vector in that of its largest component, since that is what is left of it as a unit vector.
static void jitter(struct sb_points *points, struct sb_random *random)
{
    for (int p = 0; p < points->count; p++)
        for (int k = 0; k < sb_knob_count; k++) {
            float *value = sb_knob_of(points, p, &sb_knobs[k], 0), largest = 0;
            for (int c = 0; c < sb_knobs[k].components; c++)
                largest = fmaxf(largest, fabsf(value[c]));
            for (int c = 0; c < sb_knobs[k].components; c++)
                value[c] += largest * 0x1p-23f * ((float)sb_random_below(random, 3) - 1);
        }
}

static void copy_points(const struct sb_points *from, struct sb_points *to)
{
    *to = *from;
    const size_t points = (size_t)from->count, lights = points * (size_t)from->lights;
    to->capacity = from->count;
    to->point = memcpy(sb_alloc(points * sizeof *to->point), from->point,
                       points * sizeof *to->point);
    to->light = memcpy(sb_alloc((lights + 1) * sizeof *to->light), from->light,
                       lights * sizeof *to->light);
}

static double distance(struct sb_vec3 a, struct sb_vec3 b)
{
    return fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.z - b.z))) /
           fmax(1, fmax(fabs(b.x), fmax(fabs(b.y), fabs(b.z))));
}

// How far the reference moves when its inputs do.
static void spread_all(struct search *search, const struct sb_points *points,
                       const struct sb_points_truth *truth, struct score *score)
{
    for (int j = 0; j < JITTERS; j++) {
        struct sb_points moved;
        struct sb_points_truth other = {0};
        copy_points(points, &moved);
        jitter(&moved, &search->random);
        sb_points_truth_make(&moved, &search->variant, &other);
        for (int p = 0; p < points->count; p++)
            score[p].spread =
                fmax(score[p].spread, 255 * distance(other.colour[p], truth->colour[p]));
        sb_points_truth_free(&other);
        sb_points_free(&moved);
    }
}

static bool score_all(struct search *search, struct sb_points *points,
                      struct score *score, struct sb_error *err)
{
    const bool half = sb_case_precisions[search->params->precision].half;
    const double bound = sb_criterion_bound(&wrong, search->params->precision);
    struct sb_unit_told told = {0};
    struct sb_points_truth truth = {0};
    if (half)
        sb_points_round(points);
    const bool good = sb_unit_light(&search->unit, points, 0, &told, err);
    if (good) {
        sb_points_truth_make(points, &search->variant, &truth);
        const struct sb_judged judged = {&search->it, &search->setting, points, &told,
                                         &truth};
        for (int p = 0; p < points->count; p++)
            score[p] = (struct score){
                .point = p,
                .measured = sb_judge_point(&judged, &not_finite, p) > 0
                                ? INFINITY
                                : sb_judge_point(&judged, &wrong, p),
            };
        spread_all(search, points, &truth, score);
        // In half precision an input's last place is 2^13 of binary32's.
        for (int p = 0; p < points->count; p++)
            score[p].value =
                isinf(score[p].measured)
                    ? INFINITY
                    : score[p].measured /
                          fmax(bound, 4 * score[p].spread * (half ? 0x1p13 : 1));
    }
    search->findings->asked += points->count;
    sb_points_truth_free(&truth);
    sb_unit_told_free(&told);
    return good;
}

// --- breeding -----------------------------------------------------------------------------

static int by_value(const void *a, const void *b)
{
    const struct score *one = a, *other = b;
    return (one->value < other->value) - (one->value > other->value);
}

static void draw_point(struct search *search, struct sb_points *points, int point)
{
    for (int k = 0; k < sb_knob_count; k++)
        for (int c = 0; c < sb_knobs[k].components; c++)
            if (sb_random_below(&search->random, 2))
                *sb_knob_of(points, point, &sb_knobs[k], c) =
                    (float)sb_knob_draw(&sb_knobs[k], &search->random);
    sb_knobs_settle(points, point);
}

static void breed_point(struct search *search, struct sb_points *points, int child,
                        int parent)
{
    points->point[child] = points->point[parent];
    for (int i = 0; i < points->lights; i++)
        *sb_points_light(points, child, i) = *sb_points_light(points, parent, i);
    for (uint64_t turns = 1 + sb_random_below(&search->random, 4); turns > 0; turns--) {
        const struct sb_knob *knob =
            &sb_knobs[sb_random_below(&search->random, (uint64_t)sb_knob_count)];
        float *value =
            sb_knob_of(points, child, knob,
                       (int)sb_random_below(&search->random, (uint64_t)knob->components));
        *value = (float)sb_knob_turn(knob, *value, &search->random);
    }
    sb_knobs_settle(points, child);
}

// The parents come first; a quarter of the rest is new.
static void breed(struct search *search, const struct sb_points *old,
                  const struct score *score, struct sb_points *next)
{
    for (int p = 0; p < HERD; p++) {
        sb_points_add(next);
        if (p >= PARENTS)
            continue;
        next->point[p] = old->point[score[p].point];
        for (int i = 0; i < next->lights; i++)
            *sb_points_light(next, p, i) = *sb_points_light(old, score[p].point, i);
    }
    for (int p = PARENTS; p < HERD; p++)
        if (sb_random_below(&search->random, 4) == 0)
            draw_point(search, next, p);
        else
            breed_point(search, next, p, (int)sb_random_below(&search->random, PARENTS));
}

// --- shrinking ----------------------------------------------------------------------------

// The value with fewer digits.
static double rounded_to(double value, int digits)
{
    char text[64];
    snprintf(text, sizeof text, "%.*g", digits, value);
    return strtod(text, NULL);
}

// A point for each simpler value of each knob: what a plain point has, or fewer digits.
static void simplify(const struct sb_points *from, struct sb_points *to)
{
    struct sb_points plain = sb_points_like(from);
    sb_points_add(&plain);
    for (int k = 0; k < sb_knob_count; k++)
        for (int c = 0; c < sb_knobs[k].components; c++)
            for (int digits = 0; digits < 4; digits++) {
                const float now = *sb_knob_of(from, 0, &sb_knobs[k], c);
                const float simple = digits == 0 ? *sb_knob_of(&plain, 0, &sb_knobs[k], c)
                                                 : (float)rounded_to(now, digits);
                if (simple == now)
                    break; // as simple as it gets
                sb_points_add(to);
                to->point[to->count - 1] = from->point[0];
                for (int i = 0; i < to->lights; i++)
                    *sb_points_light(to, to->count - 1, i) = *sb_points_light(from, 0, i);
                *sb_knob_of(to, to->count - 1, &sb_knobs[k], c) = simple;
                sb_knobs_settle(to, to->count - 1);
            }
    sb_points_free(&plain);
}

// One simpler value at a time, the first that is still found, until none is.
static bool shrink(struct search *search, struct sb_found *found, struct sb_error *err)
{
    enum { STEPS = 200 };
    bool good = true, simpler = true;
    for (int step = 0; good && simpler && step < STEPS; step++) {
        struct sb_points tried = sb_points_like(&found->points);
        simplify(&found->points, &tried);
        struct score *score = sb_alloc((size_t)(tried.count + 1) * sizeof *score);
        good = tried.count == 0 || score_all(search, &tried, score, err);
        simpler = false;
        for (int p = 0; good && !simpler && p < tried.count; p++)
            if (score[p].value > 1) {
                found->points.point[0] = tried.point[p];
                for (int i = 0; i < tried.lights; i++)
                    *sb_points_light(&found->points, 0, i) =
                        *sb_points_light(&tried, p, i);
                found->measured = score[p].measured;
                found->spread = score[p].spread;
                simpler = true;
            }
        free(score);
        sb_points_free(&tried);
    }
    return good;
}

// --- all of it ----------------------------------------------------------------------------

static bool keep(struct search *search, const char *given, const struct sb_points *points,
                 const struct score *best, struct sb_error *err)
{
    struct sb_findings *findings = search->findings;
    struct sb_found found = {
        .given = given, .measured = best->measured, .spread = best->spread};
    for (int i = 0; i < findings->count; i++)
        if (findings->row[i].given == given)
            return true;
    found.points = sb_points_like(points);
    sb_points_add(&found.points);
    found.points.point[0] = points->point[best->point];
    for (int i = 0; i < points->lights; i++)
        *sb_points_light(&found.points, 0, i) = *sb_points_light(points, best->point, i);
    const bool good = shrink(search, &found, err);
    findings->row = sb_grow(findings->row, findings->count, &findings->capacity,
                            sizeof *findings->row);
    findings->row[findings->count++] = found;
    return good;
}

static bool search_look(struct search *search, const char *given, int64_t end,
                        struct sb_error *err)
{
    static struct score score[HERD];
    struct sb_points herd;
    bool good = true, found = false;
    sb_points_init(&herd, &search->variant);
    for (int p = 0; p < HERD; p++) {
        sb_points_add(&herd);
        draw_point(search, &herd, p);
    }
    for (int g = 0; good && !found && g < GENERATIONS && sb_clock_ns() < end; g++) {
        struct sb_points next;
        good = score_all(search, &herd, score, err);
        if (!good)
            break;
        qsort(score, HERD, sizeof *score, by_value);
        found = score[0].value > 1;
        if (found)
            good = keep(search, given, &herd, &score[0], err);
        sb_points_init(&next, &search->variant);
        breed(search, &herd, score, &next);
        sb_points_free(&herd);
        herd = next;
    }
    sb_points_free(&herd);
    return good;
}

bool sb_search(const struct sb_search_params *params, struct sb_findings *findings,
               struct sb_error *err)
{
    const int64_t end = sb_clock_ns() + (int64_t)(params->seconds * 1e9);
    struct search search = {
        .params = params,
        .findings = findings,
        .it = {.id = "search", .hdr = true, .form = {"form=naive", ""}},
        .random = sb_random_seed(params->seed),
    };
    search.setting =
        (struct sb_case_setting){params->form, params->precision, false, &search.variant};
    bool good = true;
    for (int turn = 0; good && sb_clock_ns() < end; turn++) {
        if (params->stop && params->stop(params->user))
            break;
        search.it.given = looks[turn % LOOKS];
        good = sb_case_variant(params->env, &search.it, params->form, params->precision,
                               false, NULL, &search.variant, err) &&
               sb_case_unit_open(&search.unit, params->env, &search.variant, err) &&
               search_look(&search, search.it.given, end, err);
        sb_unit_close(&search.unit);
    }
    return good;
}

void sb_findings_free(struct sb_findings *findings)
{
    for (int i = 0; i < findings->count; i++)
        sb_points_free(&findings->row[i].points);
    free(findings->row);
    *findings = (struct sb_findings){0};
}
