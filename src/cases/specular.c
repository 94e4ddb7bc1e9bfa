// Highlights: the power of a cosine, its base, its exponent, and what cuts it.
#include <math.h>
#include <stdio.h>

#include "cases/case.h"
#include "cases/directions.h"
#include "measure/explain.h"

// --- directions ---------------------------------------------------------------------------

static void store(float out[3], struct sb_vec3 v, double scale)
{
    out[0] = (float)(scale * v.x);
    out[1] = (float)(scale * v.y);
    out[2] = (float)(scale * v.z);
}

// A point of specular colour alone, whose half vector is `angle` from its normal, in a random
// direction. `slant`: angle of light and view to the half vector.
static struct sb_point *at_angle(struct sb_points *points, struct sb_random *random,
                                 double angle, double slant)
{
    const struct sb_vec3 half = sb_any_direction(random);
    const struct sb_vec3 view = sb_turned(random, half, slant);
    const struct sb_vec3 to_light =
        sb_vec3_sub(sb_vec3_scale(half, 2 * sb_vec3_dot(half, view)), view);
    struct sb_point *point = sb_points_add(points);
    store(point->normal, sb_turned(random, half, angle), 1);
    store(point->eye, view, 2);
    store(point->material.diffuse, view, 0);
    store(sb_points_light(points, points->count - 1, 0)->direction, to_light, -1);
    return point;
}

// --- spec-pow-16, spec-pow-32, pow-builtin-16 ----------------------------------------------

// What the catalogue allows in half precision, in steps of 1/255, by exponent.
static double allowed(double exponent)
{
    return exponent <= 64 ? 1.5 : exponent <= 256 ? 3 : 5;
}

// All over the highlight, in as many random directions. Its colour is `colour`.
static void highlight(struct sb_points *points, double exponent, double colour)
{
    enum { ROUNDS = 12, VALUES = 16 };
    struct sb_random random = sb_random_seed(1);
    for (int i = 0; i < ROUNDS * VALUES; i++) {
        const double value = (double)(i % VALUES + 1) / VALUES;
        // 1 - cos a = 2 sin^2(a / 2) of cos^n a = value
        const double angle = 2 * asin(sqrt(-0.5 * expm1(log(value) / exponent)));
        const double slant = fmax(SB_PI / 2.25 - angle, 0) * sb_random_unit(&random);
        struct sb_point *point = at_angle(points, &random, angle, slant);
        point->material.shininess = (float)exponent;
        for (int c = 0; c < 3; c++)
            point->material.specular[c] = (float)colour;
    }
}

// Of specular colours by which all that is allowed becomes what is allowed up to 64.
static void weighted(struct sb_points *points, const struct sb_case_setting *setting,
                     double exponent)
{
    (void)setting;
    highlight(points, exponent, allowed(1) / allowed(exponent));
}

static void white(struct sb_points *points, const struct sb_case_setting *setting,
                  double exponent)
{
    (void)setting;
    highlight(points, exponent, 1);
}

static void up_to_1024(struct sb_points *points, const struct sb_case_setting *setting)
{
    static const double exponent[] = {1, 4, 16, 32, 64, 128, 256, 1024};
    for (size_t i = 0; i < sizeof exponent / sizeof *exponent; i++)
        weighted(points, setting, exponent[i]);
}

static void up_to_a_million(struct sb_points *points,
                            const struct sb_case_setting *setting)
{
    static const double exponent[] = {64, 1024, 16384, 65536, 262144, 1e6};
    for (size_t i = 0; i < sizeof exponent / sizeof *exponent; i++)
        white(points, setting, exponent[i]);
}

// --- pow-zero-zero ------------------------------------------------------------------------

// Half vectors across the normal, of light and view that have the sides of the surface between
// them: a cosine of exactly 0.
static void across(struct sb_points *points, const struct sb_case_setting *setting,
                   float exponent)
{
    static const float sine[] = {1, 0.75f, 0.5f, 0.25f};
    (void)setting;
    for (size_t i = 0; i < sizeof sine / sizeof *sine; i++) {
        struct sb_point *point = sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        store(point->eye, (struct sb_vec3){1, 0, -sine[i]}, 1);
        store(light->direction, (struct sb_vec3){-1, 0, -sine[i]}, 1);
        store(point->material.diffuse, (struct sb_vec3){0, 0, 0}, 0);
        point->material.shininess = exponent;
    }
}

static void least_exponent(struct sb_points *points,
                           const struct sb_case_setting *setting)
{
    across(points, setting, 0x1.1p-10f); // at least 0.001, and half precision has it
}

static void no_exponent(struct sb_points *points, const struct sb_case_setting *setting)
{
    across(points, setting, 0);
}

// The naive form lets an exponent of 0 through, as an upload does that checks nothing. The robust
// one refuses it, and is asked at the least exponent that scenes may have.
static bool ask_zero_zero(const struct sb_case_env *env, const struct sb_case *it,
                          const struct sb_case_setting *setting,
                          struct sb_outcome *outcome, struct sb_error *err)
{
    const bool naive = setting->form == SB_CASE_NAIVE;
    struct sb_points zero, asked;
    struct sb_error message = {0};
    sb_points_init(&zero, setting->variant);
    sb_points_init(&asked, setting->variant);
    no_exponent(&zero, setting);
    (naive ? no_exponent : least_exponent)(&asked, setting);
    const bool refused = !sb_points_validate(&zero, &message);
    const bool good = sb_case_ask_points(env, it, setting, &asked, outcome, err);
    sb_points_free(&zero);
    sb_points_free(&asked);
    if (!good || naive)
        return good;
    if (!refused) {
        outcome->verdict = SB_VERDICT_FAIL;
        sb_text_add(&outcome->note, "an exponent of 0 is not refused");
    } else if (outcome->verdict == SB_VERDICT_PASS) {
        outcome->verdict = SB_VERDICT_REFUSED;
        sb_text_add(&outcome->note, message.text);
    }
    return true;
}

// --- pow-negative-base --------------------------------------------------------------------

// Seen from where the light is: the cosine is 1, or what rounding makes of it.
static void head_on(struct sb_points *points, const struct sb_case_setting *setting)
{
    enum { POINTS = 200 };
    struct sb_random random = sb_random_seed(2);
    (void)setting;
    for (int i = 0; i < POINTS; i++)
        at_angle(points, &random, 0.5, 0);
}

// --- spec-underflow-16 --------------------------------------------------------------------

// Where the power is below 2^-14 and its factor of 81 and more makes something of it.
static void tail(struct sb_points *points, const struct sb_case_setting *setting)
{
    static const double exponent[] = {2048, 4096};
    struct sb_random random = sb_random_seed(3);
    (void)setting;
    for (int i = 0; i < 400; i++) {
        const double n = exponent[i % 2];
        const double log2_power = -14 - 6 * sb_random_unit(&random);
        const double angle = 2 * asin(sqrt(-0.5 * expm1(log2_power * log(2) / n)));
        struct sb_point *point =
            at_angle(points, &random, angle, sb_random_unit(&random));
        point->material.shininess = (float)n;
    }
}

// --- spec-backface ------------------------------------------------------------------------

// A ball, lit from behind its right edge.
static void ball(struct sb_points *points, const struct sb_case_setting *setting)
{
    enum { SIDE = 64 };
    (void)setting;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = 2.0 * (i % SIDE + 0.5) / SIDE - 1;
        const double y = 2.0 * (i / SIDE + 0.5) / SIDE - 1;
        if (x * x + y * y >= 1)
            continue;
        struct sb_point *point = sb_points_add(points);
        store(point->normal, (struct sb_vec3){x, y, sqrt(1 - x * x - y * y)}, 1);
        store(point->material.diffuse, (struct sb_vec3){0, 0, 0}, 0);
        point->material.shininess = 4;
        store(sb_points_light(points, points->count - 1, 0)->direction,
              (struct sb_vec3){0.8, 0.36, -0.48}, -1);
    }
}

// --- acos-angle ---------------------------------------------------------------------------

static void cone_angles(struct sb_points *points, const struct sb_case_setting *setting)
{
    static const double cutoff[] = {2, 5, 10, 30, 60, 85};
    static const double off[] = {-0.0011, 0.0011}; // degrees
    struct sb_random random = sb_random_seed(4);
    (void)setting;
    for (int i = 0; i < 1200; i++) {
        const double edge = cutoff[i % 6] * SB_PI / 180;
        const double angle = i < 900 ? 0 : edge + off[i / 6 % 2] * SB_PI / 180;
        sb_points_in_cone(points, &random, angle, edge, edge);
    }
}

#define SPECULAR "dir=1 ambient=none "
// A sharp highlight tells the rounding of the directions that it is made from, whatever is done
// with their cosine: the shipped form is then 2.6 steps of 255 off at n = 8 and 10 at n = 1024 on
// llvmpipe (6400 points each). So both forms have exact ones where the cosine and its power are on trial.
#define EXACT_VECTORS "p_position=highp p_vector=highp"

static const struct sb_case rows[] = {
    {
        .id = "spec-pow-16",
        .help =
            "half precision has lost the angle from its cosine, and the power multiplies "
            "that; half vectors alone cost 2.6 steps at n = 8, 10 at n = 1024",
        .formula = "max(N . H, 0)^n",
        .source = "Filament, brdf.fs: D_GGX, by Lagrange's identity",
        .given = SPECULAR,
        .form = {EXACT_VECTORS " f_highlight=naive", EXACT_VECTORS},
        .precisions = SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, NAN, 0},
                      // 1.5 up to n = 64, 3 up to 256, 5 up to 1024: by their colours
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, NAN, 1.5}},
        .points = up_to_1024,
        .scale = {"exponent", "", 1, 1024, weighted},
    },
    {
        .id = "spec-pow-32",
        .help = "so have 32 bits, for exponents from 10000 on",
        .formula = "max(N . H, 0)^n",
        .source = "Vulkan 1.3, precision of log2: 2^-21 in [0.5, 2]",
        .given = SPECULAR,
        .form = {"f_highlight=naive", ""},
        .precisions = SB_IN_HIGHP,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, NAN},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_specular, 0.1, NAN}},
        .points = up_to_a_million,
        .scale = {"exponent", "", 1, 1e6, white},
    },
    {
        .id = "pow-builtin-16",
        .help =
            "log2 may be wrong by 2^-7 in half precision, and the power multiplies that",
        .formula = "exp2(n log2(N . H))",
        .source = "Vulkan 1.3, precision of half-float log2: 2^-7 in [0.5, 2]; PowerVR "
                  "performance recommendations: sin, cos, pow and log in highp",
        .given = SPECULAR "emulate_builtins=allowed",
        .form = {EXACT_VECTORS, EXACT_VECTORS " p_specular=highp"},
        .precisions = SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, NAN, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, NAN, 1.5}}, // as spec-pow-16
        .points = up_to_1024,
        .holds =
            "where built-in functions are better than Vulkan allows, as llvmpipe's are; "
            "the emulation takes the allowed error",
    },
    {
        .id = "pow-zero-zero",
        .help = "0 to the power of 0 is undefined",
        .formula = "pow(max(N . H, 0), n), n = 0",
        .source = "GLSL 4.60, 8.2; PPSSPP #3547; three.js #5222; Cesium #4423",
        .given = SPECULAR,
        .form = {"f_highlight=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_LEAKS, SB_TERM_specular, 0, 0}},
        .run = ask_zero_zero,
        .on_cpu = true,
        .holds =
            "where pow(0, 0) happens to be 0 or 1, as in llvmpipe; the emulation has "
            "NaN",
    },
    {
        .id = "pow-negative-base",
        .help = "rounding makes the cosine of unit vectors larger than 1, and the base "
                "negative",
        .formula = "pow(1 - |V . H|, 5)",
        .source = "GLSL 4.60, 8.2; world-of-claudecraft #2790",
        .given = SPECULAR "fresnel=schlick",
        .form = {"f_highlight=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}},
        .points = head_on,
    },
    {
        .id = "spec-underflow-16",
        .help =
            "the power leaves half precision before the factor that it has can lift it",
        .formula = "(n + 8) / (8 pi) (N . H)^n",
        .source = "OpenGL ES 3.2, 2.3.4: subnormals may be flushed",
        .given = SPECULAR "specular_norm=energy emulate_subnormals=flush",
        .form = {"f_highlight=naive", ""},
        .precisions = SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, NAN, 0},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_specular, NAN, 1}},
        .points = tail,
    },
    {
        .id = "spec-backface",
        .help = "behind the terminator N . H is still positive: light leaks through",
        .formula = "max(N . H, 0)^n where N . L <= 0",
        .source = "Blinn 1977; OpenGL 2.1, 2.14.1: f_i",
        .given = SPECULAR,
        .form = {"specular_side=both", ""},
        .right = "specular_side=front",
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_LEAKS, SB_OF_COLOUR, 0, 0},
                      {SB_FIGURE_FLIPS, 0, 0.1, 0.1}},
        .points = ball,
    },
    {
        .id = "acos-angle",
        .help =
            "acos is NaN where rounding makes a cosine larger than 1, and coarse near it",
        .formula = "acos(L . D) <= C",
        .source = "GLSL 4.60, 8.1",
        .given = "spot=1 cone=hard attenuation=none model=lambert ambient=none",
        .form = {"f_cone=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      // all points are more than 0.001 degrees from the edge
                      {SB_FIGURE_FLIPS, 0, 0, NAN}},
        .points = cone_angles,
    },
};

const struct sb_case_family sb_cases_specular = {"specular", "the power of highlights",
                                                 rows, sizeof rows / sizeof *rows};
