// Cones of spot lights.
#include <math.h>

#include "cases/case.h"
#include "cases/directions.h"
#include "measure/explain.h"

static const double degree = SB_PI / 180;

// --- cone-narrow --------------------------------------------------------------------------

static void at_cutoff(struct sb_points *points, const struct sb_case_setting *setting,
                      double cutoff)
{
    enum { POINTS = 100 };
    struct sb_random random = sb_random_seed(1);
    (void)setting;
    for (int i = 0; i < POINTS; i++)
        sb_points_in_cone(points, &random, cutoff * degree * i / POINTS,
                          0.5 * cutoff * degree, cutoff * degree);
}

static void narrow(struct sb_points *points, const struct sb_case_setting *setting)
{
    static const double cutoff[] = {90, 45, 20, 10, 5, 2, 1, 0.1, 0.02};
    const double least = sb_case_precisions[setting->precision].half ? 10 : 0.02;
    for (size_t i = 0; i < sizeof cutoff / sizeof *cutoff; i++)
        if (cutoff[i] >= least)
            at_cutoff(points, setting, cutoff[i]);
}

// --- cutoff-0 -----------------------------------------------------------------------------

static void no_angle(struct sb_points *points, const struct sb_case_setting *setting)
{
    struct sb_random random = sb_random_seed(2);
    (void)setting;
    for (int i = 0; i < 20; i++)
        sb_points_in_cone(points, &random, 0.01 * i, 0, 0);
}

// The naive form lets a cut-off of 0 through, as an upload does that checks nothing.
static bool ask_no_angle(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting,
                         struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_points points;
    struct sb_error message = {0};
    bool good = true;
    sb_points_init(&points, setting->variant);
    no_angle(&points, setting);
    if (setting->form == SB_CASE_ROBUST && !sb_points_validate(&points, &message)) {
        outcome->verdict = SB_VERDICT_REFUSED;
        sb_text_add(&outcome->note, message.text);
    } else {
        good = sb_case_ask_points(env, it, setting, &points, outcome, err);
    }
    sb_points_free(&points);
    return good;
}

// --- cutoff-90-180 ------------------------------------------------------------------------

// As an upload has it that takes the cosine of the float next to the angle.
static void set_plain_cosine(struct sb_light *light)
{
    light->cos_cutoff = (float)cos(light->cutoff);
}

// A quarter turn: just in front of the plane through the light, on it, and behind it by as much as
// the cosine of the float is off.
static void quarter_turn(struct sb_points *points, const struct sb_case_setting *setting)
{
    const bool half = sb_case_precisions[setting->precision].half;
    const float step = half ? 0x1p-8f : 2e-8f;
    for (int i = -1; i <= 1; i++) {
        struct sb_point *point = sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        for (int c = 0; c < 3; c++) {
            point->normal[c] = c == 0;
            light->position[c] = (float)(c == 0) - (float)(c == 2) * (float)i * step;
            light->direction[c] = (float)(c == 2);
        }
        sb_light_set_cone(light, SB_PI / 2, SB_PI / 2);
        if (setting->form == SB_CASE_NAIVE)
            set_plain_cosine(light);
    }
}

// Half a turn: all is inside, on the axis behind the light too.
static void quarter_and_half_turn(struct sb_points *points,
                                  const struct sb_case_setting *setting)
{
    enum { POINTS = 1000 };
    struct sb_random random = sb_random_seed(3);
    quarter_turn(points, setting);
    for (int i = 0; i < POINTS; i++) {
        struct sb_light *light =
            sb_points_in_cone(points, &random, SB_PI * i / (POINTS / 4), SB_PI, SB_PI);
        if (i >= POINTS / 4)
            for (int c = 0; c < 3; c++) // behind
                light->position[c] = 2 * light->direction[c];
        if (setting->form == SB_CASE_NAIVE)
            set_plain_cosine(light);
    }
}

// --- inner>=outer -------------------------------------------------------------------------

// Equal angles, and an inner one that is the larger. In half precision points where the ramp of a
// 1024th lies are decisions: they are left out, but for the edge at a quarter turn, whose cosine
// is exact.
static void equal_angles(struct sb_points *points, const struct sb_case_setting *setting)
{
    enum { POINTS = 400 };
    const double clear = sb_case_precisions[setting->precision].half ? 0x1p-5 : 0;
    struct sb_random random = sb_random_seed(4);
    for (int i = 0; i < POINTS; i++) {
        const double outer = (10 + 100 * sb_random_unit(&random)) * degree;
        const double inner = outer * (i % 2 ? 1 : 1.25);
        const double angle =
            i % 4 < 2 ? outer : fmin(2 * outer * sb_random_unit(&random), SB_PI);
        if (fabs(cos(angle) - cos(outer)) >= clear)
            sb_points_in_cone(points, &random, angle, inner, outer);
    }
    struct sb_light *light = NULL;
    for (int i = 0; i < 2; i++) {
        struct sb_point *point = sb_points_add(points);
        light = sb_points_light(points, points->count - 1, 0);
        for (int c = 0; c < 3; c++) {
            point->normal[c] = c == 0;
            light->position[c] = (float)(c == 0);
            light->direction[c] = (float)(c == 2);
        }
        sb_light_set_cone(light, (i ? 1.25 : 1) * SB_PI / 2, SB_PI / 2);
    }
}

// --- spot-exp -----------------------------------------------------------------------------

// What the catalogue allows in half precision, as of highlights.
static double allowed(double exponent)
{
    return exponent <= 64 ? 1.5 : exponent <= 256 ? 3 : 5;
}

// All over the spot, inside its cut-off of 120 degrees. What is lit is ambient light, which no
// cosine to the normal multiplies, of a colour by which all that is allowed in half precision
// becomes what is allowed up to 64.
static void at_exponent(struct sb_points *points, const struct sb_case_setting *setting,
                        double exponent)
{
    enum { ROUNDS = 8, VALUES = 16 };
    const bool half = sb_case_precisions[setting->precision].half;
    struct sb_random random = sb_random_seed(5);
    for (int i = 0; i < ROUNDS * VALUES; i++) {
        const double value = (double)(i % VALUES + 1) / VALUES;
        // 1 - cos a = 2 sin^2(a / 2) of cos^n a = value; of n = 0 every angle
        const double angle = exponent > 0
                                 ? 2 * asin(sqrt(-0.5 * expm1(log(value) / exponent)))
                                 : 110 * degree * value;
        struct sb_light *light =
            sb_points_in_cone(points, &random, angle, SB_PI / 2, SB_PI / 1.5);
        struct sb_point *point = &points->point[points->count - 1];
        light->exponent = (float)exponent;
        for (int c = 0; c < 3; c++) {
            light->ambient[c] = 1;
            light->diffuse[c] = 0;
            point->material.ambient[c] =
                half ? (float)(allowed(1) / allowed(exponent)) : 1;
        }
    }
}

static void exponents(struct sb_points *points, const struct sb_case_setting *setting)
{
    static const double exponent[] = {0, 1, 4, 16, 64, 128, 256, 1024, 16384, 1e6};
    const double most = sb_case_precisions[setting->precision].half ? 1024 : 1e6;
    for (size_t i = 0; i < sizeof exponent / sizeof *exponent; i++)
        if (exponent[i] <= most)
            at_exponent(points, setting, exponent[i]);
}

// --- hard-edge ----------------------------------------------------------------------------

// The pixels of a plane under a slanted spot light, but for a ring of one pixel on either side of
// the edge of its cone, where a step may go either way.
static void plane(struct sb_points *points, const struct sb_case_setting *setting)
{
    enum { SIDE = 64 };
    const double cutoff = 30 * degree, pixel = 2.0 / SIDE;
    const struct sb_vec3 place = {0.25, -0.125, 1};
    const struct sb_vec3 axis = sb_vec3_normalise((struct sb_vec3){-0.25, 0.25, -1});
    (void)setting;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const struct sb_vec3 p = {pixel * (i % SIDE + 0.5) - 1,
                                  pixel * (i / SIDE + 0.5) - 1, 0};
        const struct sb_vec3 way = sb_vec3_sub(p, place);
        const double angle =
            atan2(sb_vec3_length(sb_vec3_cross(way, axis)), sb_vec3_dot(way, axis));
        // A pixel is at most so wide as seen from the light.
        if (fabs(angle - cutoff) < pixel / sb_vec3_length(way))
            continue;
        struct sb_point *point = sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        const double at[3] = {p.x, p.y, p.z}, from[3] = {place.x, place.y, place.z};
        const double along[3] = {axis.x, axis.y, axis.z};
        for (int c = 0; c < 3; c++) {
            point->position[c] = (float)at[c];
            light->position[c] = (float)from[c];
            light->direction[c] = (float)along[c];
        }
        sb_light_set_cone(light, cutoff, cutoff);
    }
}

#define SPOT "spot=1 attenuation=none model=lambert "

static const struct sb_case rows[] = {
    {
        .id = "cone-narrow",
        .help = "1 - cos a cancels",
        .formula = "1 - (1 - cos a) / (1 - cos C)",
        .source = "LWJGL book, chapter Let there be even more light; Lagrange's identity",
        .given = SPOT "cone=linear ambient=none",
        .form = {"f_cone=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      // C >= 0.02 degrees, in half precision C >= 10 degrees
                      {SB_FIGURE_ABSOLUTE, SB_TERM_cone, 0.2, 3}},
        .points = narrow,
        .scale = {"cut-off angle", "degrees", 90, 0.02, at_cutoff},
    },
    {
        .id = "cutoff-0",
        .help = "a cone of no angle: 0 / 0 on its axis",
        .formula = "1 - (1 - cos a) / (1 - cos C), C = 0",
        .source = "Filament, LightManager::setSpotParams",
        .given = SPOT "cone=linear ambient=none",
        .form = {"f_cone=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}},
        .run = ask_no_angle,
        .on_cpu = true,
    },
    {
        .id = "cutoff-90-180",
        .help = "the cosine of the float next to 90 degrees is below 0; at 180 rounding "
                "leaves "
                "a hole behind the light",
        .formula = "cos a >= cos C",
        .source = "OpenGL 2.1, equation 2.8",
        .given = SPOT "cone=hard ambient=none",
        .form = {"", ""},
        .right = "hoist=per_light", // from the angle itself
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}, {SB_FIGURE_FLIPS, 0, 0, 0}},
        .keeps_inputs = true, // half precision has neither angle
        .points = quarter_and_half_turn,
        .on_cpu = true,
    },
    {
        .id = "inner>=outer",
        .help =
            "smoothstep of edges that are equal, or the wrong way round, is undefined",
        .formula = "smoothstep(cos C, cos I, cos a)",
        .source = "GLSL 4.60, 8.3; Filament, LightManager::setSpotParams",
        .given = SPOT "cone=smooth ambient=none",
        .form = {"f_cone=naive", "p_attenuation=highp p_uniform=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_cone, 1, 1}},
        .points = equal_angles,
    },
    {
        .id = "spot-exp",
        .help =
            "0 to the power of 0 behind the light; large exponents multiply the error of "
            "the cosine",
        .formula = "max(cos a, 0)^e",
        .source = "OpenGL 2.1, 2.14.1; GLSL 4.60, 8.2",
        .given = SPOT "cone=exponent ambient=per_light",
        .form = {"f_cone=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      // as spec-pow-32 and spec-pow-16
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.1, 1.5}},
        .points = exponents,
        .scale = {"exponent", "", 1, 1e6, at_exponent},
    },
    {
        .id = "hard-edge",
        .help = "a step may go either way within rounding of the edge, and only there",
        .formula = "step(cos C, cos a)",
        .source = "GLSL 4.60, 8.3",
        .given = SPOT "cone=hard ambient=none",
        .form = {"f_cone=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        // all points are farther than a pixel from the edge
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}, {SB_FIGURE_FLIPS, 0, 0, 0}},
        .points = plane,
        .holds = "a step is as good as its edge: of acos only angles below 2 degrees are "
                 "coarse, "
                 "and NaN is on the axis (acos-angle)",
    },
};

const struct sb_case_family sb_cases_cones = {"cones", "cones of spot lights", rows,
                                              sizeof rows / sizeof *rows};
