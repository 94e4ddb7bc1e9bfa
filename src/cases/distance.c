// Distance, attenuation and range.
#include <math.h>
#include <string.h>

#include "cases/own.h"
#include "measure/explain.h"

// Light number 0 of a new point, at a distance from it along a slanted direction.
static struct sb_light *light_at(struct sb_points *points, double distance)
{
    static const double direction[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7};
    sb_points_add(points);
    struct sb_light *light = sb_points_light(points, points->count - 1, 0);
    for (int c = 0; c < 3; c++)
        light->position[c] = (float)(distance * direction[c]);
    return light;
}

// The law 1 / (kc + kl d + kq d^2).
static void set_law(struct sb_light *light, double constant, double linear,
                    double quadratic)
{
    light->constant = (float)constant;
    light->linear = (float)linear;
    light->quadratic = (float)quadratic;
}

static void set_colour(struct sb_light *light, double red, double green, double blue)
{
    light->diffuse[0] = (float)red;
    light->diffuse[1] = (float)green;
    light->diffuse[2] = (float)blue;
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

// --- light-on-surface ---------------------------------------------------------------------

static void on_surface(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double distance[] = {0, 0x1p-10, 0x1p-7, 0.01, 0.1, 1, 10};
    for (size_t i = 0; i < COUNT(distance); i++)
        light_at(points, distance[i]);
}

// --- att-kc0 and att-all-zero -------------------------------------------------------------

// Seen by a surface that faces the light, and by one that it grazes: there an infinite
// attenuation meets a cosine of 0.
static void inverse_square(struct sb_points *points,
                           const struct sb_case_setting *setting, double distance)
{
    (void)setting;
    for (int grazes = 0; grazes < 2; grazes++) {
        struct sb_point *point = sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        light->position[2] = (float)distance;
        set_law(light, 0, 0, 1);
        point->normal[0] = (float)grazes;
        point->normal[2] = (float)!grazes;
    }
}

static void inverse_squares(struct sb_points *points,
                            const struct sb_case_setting *setting)
{
    inverse_square(points, setting, 0);
    for (int i = -22; i < -6; i++)
        inverse_square(points, setting, pow(10, i));
    // Up to 84, where 1 / d^2 = 1e-4 is a normal half float, too.
    for (int i = 0; i < 46; i++)
        inverse_square(points, setting, 1e-6 * pow(1.5, i));
}

static void all_zero(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    set_law(light_at(points, 1), 0, 0, 0);
    set_law(light_at(points, 100), 0, 0, 0);
}

// --- dist-overflow16, dist-underflow16, dist-range32 ---------------------------------------

// The law of distance: 1 / d.
static void at_distance(struct sb_points *points, const struct sb_case_setting *setting,
                        double distance)
{
    (void)setting;
    set_law(light_at(points, distance), 0, 1, 0);
}

static void far_away(struct sb_points *points, const struct sb_case_setting *setting)
{
    for (int i = 0; i < 78; i++) // up to 2.8e4
        at_distance(points, setting, 0x1p-10 * pow(1.25, i));
}

// The same; nearer than 1e-3, where colours would leave half precision, not attenuated.
static void near_by(struct sb_points *points, const struct sb_case_setting *setting,
                    double distance)
{
    (void)setting;
    set_law(light_at(points, distance), distance < 1e-3, distance >= 1e-3, 0);
}

static void closer(struct sb_points *points, const struct sb_case_setting *setting)
{
    for (int i = 0; i < 59; i++) // down to 2.4e-7
        near_by(points, setting, 0.1 * pow(0.8, i));
}

static void ends_of_floats(struct sb_points *points,
                           const struct sb_case_setting *setting)
{
    (void)setting;
    static const double distance[] = {1e-38, 1e-30, 1e-23,  1.2e-19, 1e-19, 1e-3,
                                      1e12,  1e18,  1.9e19, 3e19,    1e38};
    for (size_t i = 0; i < COUNT(distance); i++)
        light_at(points, distance[i]);
}

// --- radius-falloff -----------------------------------------------------------------------

static void about_range(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double range[] = {1, 3.3, 10, 200};
    for (int i = 0; i < 3; i++) // no reach at all: on it, beside it, far off
        light_at(points, i == 0 ? 0 : i == 1 ? 1e-3 : 100)->range = 0;
    for (size_t i = 0; i < COUNT(range); i++)
        for (int k = 0; k <= 24; k++) {
            light_at(points, range[i] * (1 - ldexp(1, -k)))->range = (float)range[i];
            light_at(points, range[i] * (1 + ldexp(1, -k - 2)))->range = (float)range[i];
        }
}

// --- hdr-overflow -------------------------------------------------------------------------

// Two lights: one alone is too bright, or only both. Their sum is a float: of an infinite one the
// hue is gone before it is written.
static void bright(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double pair[][2] = {{0.5, 0},   {3e4, 3e4}, {4e4, 4e4}, {65504, 65504},
                                     {70000, 0}, {1e6, 1e6}, {1e9, 1},   {1e38, 1e38}};
    for (size_t i = 0; i < COUNT(pair); i++) {
        sb_points_add(points);
        for (int l = 0; l < 2; l++)
            set_colour(sb_points_light(points, points->count - 1, l), pair[i][l],
                       0.4 * pair[i][l], 0.05 * pair[i][l]);
    }
}

static double largest_of(const float *colour)
{
    return fmax(colour[0], fmax(colour[1], colour[2]));
}

// By how much of `wanted` the largest channel is off; black in the place of light has no hue that
// could be wrong, and is as wrong as can be.
static double magnitude_error(double most, double wanted)
{
    const double bounded = fmin(wanted, 65504);
    return most > 0 ? fabs(most - bounded) / bounded : INFINITY;
}

// What is finite is held against the hue of the right colour, largest channel 1, and against its
// largest channel, which ends at 65504.
static void judge_bright(const struct sb_case *it, const struct sb_case_setting *setting,
                         const struct sb_image *sums, const struct sb_points_truth *truth,
                         struct sb_outcome *outcome)
{
    double bad = 0, hue = 0, magnitude = 0;
    for (int p = 0; p < sums->width; p++) {
        const float *told = sums->data + (size_t)p * (size_t)sums->channels;
        const struct sb_vec3 right = truth->colour[p];
        const double most = largest_of(told);
        const double wanted = fmax(right.x, fmax(right.y, right.z));
        const double channel[] = {right.x, right.y, right.z};
        if (wanted > 0)
            magnitude = fmax(magnitude, magnitude_error(most, wanted));
        for (int c = 0; c < 3; c++) {
            const bool sound = isfinite(told[c]) && told[c] >= 0;
            bad += !sound;
            if (sound && most > 0 && isfinite(most))
                hue = fmax(hue, 255 * fabs(told[c] / most - channel[c] / wanted));
        }
    }
    const double measured[] = {bad, hue, magnitude}; // in the order of the criteria
    for (size_t i = 0; i < COUNT(measured); i++)
        sb_outcome_measured(outcome, it->criterion[i].figure, measured[i],
                            sb_criterion_bound(&it->criterion[i], setting->precision));
}

// Through the variant's own target, whose format is on trial: each point is followed by a black one
// that is added to it, because only sums are drawn there.
static bool run_bright(const struct sb_case_env *env, const struct sb_case *it,
                       const struct sb_case_setting *setting, struct sb_outcome *outcome,
                       struct sb_error *err)
{
    struct sb_points points, drawn;
    struct sb_points_truth truth = {0};
    struct sb_unit unit = {0};
    struct sb_image sums = {0};
    sb_points_init(&points, setting->variant);
    sb_points_init(&drawn, setting->variant);
    it->points(&points, setting);
    for (int p = 0; p < points.count; p++) {
        sb_points_add(&drawn);
        memset(sb_points_add(&drawn)->material.diffuse, 0, sizeof(float[3]));
        for (int l = 0; l < points.lights; l++)
            *sb_points_light(&drawn, 2 * p, l) = *sb_points_light(&points, p, l);
    }
    const bool good = sb_case_unit_open(&unit, env, setting->variant, err) &&
                      sb_unit_add(&unit, &drawn, 2, &sums, err);
    if (good) {
        sb_points_truth_make(&points, setting->variant, &truth);
        judge_bright(it, setting, &sums, &truth, outcome);
    }
    sb_points_truth_free(&truth);
    sb_image_free(&sums);
    sb_unit_close(&unit);
    sb_points_free(&drawn);
    sb_points_free(&points);
    return good;
}

// --- neg-denorm-intensity -----------------------------------------------------------------

// Of two lights; -0 is no negative number.
static void odd_colours(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double pair[][2] = {{-1, 0},    {2, -1},       {-1, 2},       {NAN, 0},
                                     {0, NAN},   {1, INFINITY}, {-0.0, -0.0},  {1e-40, 0},
                                     {0, 1e-40}, {-0.0, 1e-40}, {1e-40, -0.0}, {0, 0}};
    for (size_t i = 0; i < COUNT(pair); i++) {
        sb_points_add(points);
        for (int l = 0; l < 2; l++)
            set_colour(sb_points_light(points, points->count - 1, l), pair[i][l],
                       pair[i][l], pair[i][l]);
    }
}

// --- lowp-range ---------------------------------------------------------------------------

// So many lights that together are 4, or of which each is less than half a step of 1/256.
static void beyond_lowp(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double each[] = {0.25, 0.0019, 0.5, 0.125, 0.03};
    for (size_t i = 0; i < COUNT(each); i++)
        for (int texel = 0; texel <= 255; texel += 51) {
            struct sb_point *point = sb_points_add(points);
            for (int c = 0; c < 3; c++)
                point->texel[SB_MAP_DIFFUSE][c] = (float)texel / 255;
            for (int l = 0; l < points->lights; l++) {
                struct sb_light *light = sb_points_light(points, points->count - 1, l);
                light->position[2] = 3; // beyond 2, too
                set_colour(light, each[i], each[i], each[i]);
            }
        }
}

// --- the table ----------------------------------------------------------------------------

enum { BOTH_STAGES = SB_IN_FRAGMENT | SB_IN_VERTEX };

static const struct sb_case rows[] = {
    {
        .id = "light-on-surface",
        .help = "a light on the surface has no direction: 0 / 0",
        .formula = "L = D / |D|",
        .source = "Filament, light_punctual.fs: getSquareFalloffAttenuation",
        .given = "point=1 attenuation=none model=lambert ambient=none",
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, 2}},
        .points = on_surface,
    },
    {
        .id = "att-kc0",
        .help = "without a constant, attenuation is infinite at the light",
        .formula = "1 / (kq d^2)",
        .source = "OpenGL 2.1, 2.14.1, has the law and leaves kc = 0 open",
        .given = "point=1 model=lambert ambient=none",
        .form = {"f_attenuation=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        // Nearer than 0.01 the right value is the bound of the robust form, which textbooks do not
        // have: there the naive form is judged by what comes first, infinities and NaN, and no
        // scale is asked for the distance at which the two part. Half precision rounds the
        // distance twice (it is squared), the square and the quotient.
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_RISES, SB_TERM_attenuation, 0, 0},
                      {SB_FIGURE_RELATIVE, SB_TERM_attenuation, 1e-5, 8 * 0x1p-11}},
        .points = inverse_squares,
    },
    {
        .id = "att-all-zero",
        .help = "an attenuation of no terms is 1 / 0 everywhere",
        .formula = "1 / (kc + kl d + kq d^2)",
        .source = "OpenGL 2.1, 2.14.1",
        .given = "point=1 model=lambert ambient=none",
        .form = {"f_attenuation=naive", ""},
        .precisions = SB_IN_HIGHP,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}},
        .points = all_zero,
        .run = sb_case_run_upload,
        .on_cpu = true,
    },
    {
        .id = "dist-overflow16",
        .help = "the square of a distance from 256 on leaves half precision",
        .formula = "L = D inversesqrt(D . D)",
        .source = "three.js #14752; Unity SRP #3141, #4911",
        .given = "point=1 model=lambert ambient=none",
        .form = {"f_unit=naive", "p_position=highp p_attenuation=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ANGLE, SB_TERM_direction, 0.1, 0.1},
                      {SB_FIGURE_RELATIVE, SB_TERM_attenuation, 1e-5, 4 * 0x1p-11}},
        .points = far_away,
        .scale = {"distance", "units", 1, 3e4, at_distance},
    },
    {
        .id = "dist-underflow16",
        .help =
            "the square of a distance below 0.008 is no normal half float, and then 0",
        .formula = "L = D inversesqrt(D . D)",
        .source = "Filament, common_math.glsl: MEDIUMP_FLT_MIN = 2^-14",
        .given = "point=1 model=lambert ambient=none emulate_subnormals=flush",
        // Where what is below 2^-14 is flushed, a mediump place has lost the distance already.
        .form = {"f_unit=naive",
                 "p_position=highp p_attenuation=highp p_uniform=highp p_varying=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ANGLE, SB_TERM_direction, 0.1, 0.1},
                      {SB_FIGURE_RELATIVE, SB_TERM_attenuation, 1e-5, 4 * 0x1p-11}},
        .points = closer,
        .scale = {"distance", "units", 1, 1e-6, near_by},
    },
    {
        .id = "dist-range32",
        .help = "squares of distances beyond 1.8e19 and below 1e-19 leave floats",
        .formula = "L = D inversesqrt(D . D)",
        .source = "IEEE 754 binary32; GLSL 4.60, 4.7.1, lets subnormals be flushed",
        .given = "point=1 model=lambert ambient=none",
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, NAN}},
        .points = ends_of_floats,
        .run = sb_case_run_upload,
        .on_cpu = true,
    },
    {
        .id = "radius-falloff",
        .help = "a light of no reach is 0 / 0 where it is",
        .formula = "max(1 - d / r, 0)",
        .source = "Filament, LightManager: the inverse of the radius is made on the CPU",
        .given = "point=1 attenuation=radius model=lambert ambient=none",
        .form = {"f_attenuation=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_attenuation, 0.5, 1}},
        .points = about_range,
    },
    {
        .id = "hdr-overflow",
        .help = "light beyond 65504 is infinite in a target or output of half floats",
        .formula = "o_color = colour",
        .source = "Filament #9380; Unity SRP #4020; GLSL ES 3.20, 4.5.2",
        .given = "point=2 attenuation=none model=lambert ambient=none target=rgba16f",
        .form = {"f_output=naive p_color=highp p_uniform=highp p_sum=highp",
                 "p_color=highp p_uniform=highp p_sum=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, 1},
                      // Twice a rounding: of what is written, and of what is added to it.
                      {SB_FIGURE_RELATIVE, SB_OF_COLOUR, 0x1p-10, 0x1p-10}},
        .keeps_inputs = true, // half floats end at 65504
        .points = bright,
        .run = run_bright,
    },
    {
        .id = "neg-denorm-intensity",
        .help = "light below 0 and not finite is uploaded; light of 1e-40 may be flushed",
        .formula = "sum of max(I, 0) is not max(sum of I, 0)",
        .source = "GLSL 4.60, 4.7.1: subnormals may be flushed",
        .given = "point=2 attenuation=none model=lambert ambient=none",
        .form = {"", ""},
        .precisions = SB_IN_HIGHP,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, NAN},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 255 * 0x1p-126, NAN}},
        .points = odd_colours,
        .run = sb_case_run_upload,
        .on_cpu = true,
    },
    {
        .id = "lowp-range",
        .help = "lowp ends at 2, in steps of 1/256",
        .formula = "colour += light, all of it lowp",
        .source = "GLSL ES 3.20, 4.7.3; Arm, Minimize precision",
        .given = "point=16 attenuation=none model=lambert ambient=none maps=diffuse",
        // What is left in lowp is a texel of 8 bits.
        .form = {"",
                 "p_position=highp p_vector=highp p_attenuation=highp p_specular=highp "
                 "p_color=highp p_sum=highp p_output=highp p_varying=highp "
                 "p_uniform=highp"},
        .precisions = SB_IN_FIXED,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FINITE, 0, NAN, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, NAN, 2}},
        .hdr = true,
        .points = beyond_lowp,
    },
};

const struct sb_case_family sb_cases_distance = {
    "distance", "distance, attenuation and range", rows, sizeof rows / sizeof *rows};
