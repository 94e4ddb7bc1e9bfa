#include "cases/breaking.h"

#include <math.h>

#include "cases/judge.h"

enum { PLACES = 32, ROUNDS = 3 };

// What one round asks: the points of all places in one table, place after place.
struct asked {
    const struct sb_case *it;
    const struct sb_case_setting *setting;
    struct sb_points points;
    struct sb_unit_told told;
    struct sb_points_truth truth;
    double x[PLACES];
    int first[PLACES + 1]; // point of each place
};

// From `from` to `to`, both among them.
static double place_of(double from, double to, int i)
{
    return from * pow(to / from, (double)i / (PLACES - 1));
}

static void put_points(struct asked *asked, double from, double to)
{
    const struct sb_case *it = asked->it;
    sb_points_init(&asked->points, asked->setting->variant);
    for (int i = 0; i < PLACES; i++) {
        asked->x[i] = place_of(from, to, i);
        asked->first[i] = asked->points.count;
        it->scale.points(&asked->points, asked->setting, asked->x[i]);
    }
    asked->first[PLACES] = asked->points.count;
    if (sb_case_precisions[asked->setting->precision].half && !it->keeps_inputs)
        sb_points_round(&asked->points);
}

// --- one place ----------------------------------------------------------------------------

static struct sb_image part_of(const struct sb_image *image, int first, int count)
{
    struct sb_image part = *image;
    part.data += (size_t)first * (size_t)image->channels;
    part.width = count;
    return part;
}

static void judge_place(const struct asked *asked, int place, struct sb_outcome *outcome)
{
    enum { LIGHTS = 8 }; // as many as sb_unit_light is asked for
    const int first = asked->first[place], count = asked->first[place + 1] - first;
    const int lights = asked->points.lights;
    struct sb_image light[LIGHTS];
    struct sb_points points = asked->points;
    points.point += first;
    points.light += first * lights;
    points.count = count;
    struct sb_unit_told told = {
        .inputs = part_of(&asked->told.inputs, first, count),
        .frame = part_of(&asked->told.frame, first, count),
        .light = light,
        .lights = asked->told.lights,
    };
    for (int i = 0; i < told.lights; i++)
        light[i] = part_of(&asked->told.light[i], first, count);
    const struct sb_points_truth truth = {
        asked->truth.shade + first,
        asked->truth.colour + first,
        asked->truth.terms + first * lights,
    };
    const struct sb_judged judged = {asked->it, asked->setting, &points, &told, &truth};
    sb_judge_all(&judged, outcome);
}

// --- rounds -------------------------------------------------------------------------------

// The first place that does not hold, or PLACES.
static bool ask_round(const struct sb_unit *unit, struct asked *asked, double from,
                      double to, int *broken, struct sb_outcome *outcome,
                      struct sb_error *err)
{
    put_points(asked, from, to);
    const int lights = sb_case_lights_asked(asked->it, &asked->points);
    const bool good = sb_unit_light(unit, &asked->points, lights, &asked->told, err);
    if (good) {
        sb_points_truth_make(&asked->points, asked->setting->variant, &asked->truth);
        struct sb_outcome now = *outcome;
        for (*broken = 0; *broken < PLACES; ++*broken) {
            judge_place(asked, *broken, &now);
            if (now.verdict == SB_VERDICT_FAIL)
                break;
        }
        if (*broken < PLACES)
            *outcome = now;
    }
    sb_points_truth_free(&asked->truth);
    sb_unit_told_free(&asked->told);
    sb_points_free(&asked->points);
    return good;
}

bool sb_case_break(const struct sb_case_env *env, const struct sb_case *it,
                   enum sb_case_form form, enum sb_case_precision precision, bool vertex,
                   struct sb_breaking *breaking, struct sb_error *err)
{
    struct sb_variant variant;
    struct sb_unit unit = {0};
    const struct sb_case_setting setting = {form, precision, vertex, &variant};
    struct asked asked = {.it = it, .setting = &setting};
    double from = it->scale.from, to = it->scale.to;
    *breaking = (struct sb_breaking){
        .holds_to = NAN,
        .outcome = {SB_VERDICT_PASS, .measured = NAN, .bound = NAN, .point = -1},
    };
    bool good = sb_case_variant(env, it, form, precision, vertex, NULL, &variant, err) &&
                sb_case_unit_open(&unit, env, &variant, err);
    for (int round = 0; good && round < ROUNDS; round++) {
        int broken = 0;
        good = ask_round(&unit, &asked, from, to, &broken, &breaking->outcome, err);
        if (!good || broken == 0) // a later round begins with a place that held
            break;
        breaking->holds_to = asked.x[broken - 1];
        breaking->to_the_end = round == 0 && broken == PLACES;
        if (broken == PLACES)
            break;
        from = asked.x[broken - 1];
        to = asked.x[broken];
    }
    sb_unit_close(&unit);
    return good;
}
