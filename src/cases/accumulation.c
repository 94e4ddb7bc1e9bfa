// Sums over lights, masks, interpolation, and what compilers may do.
#include "cases/accumulation.h"

#include <math.h>
#include <string.h>

#include "cases/own.h"
#include "math/random.h"
#include "measure/explain.h"

static void set_white(struct sb_light *light, double value)
{
    for (int c = 0; c < 3; c++)
        light->diffuse[c] = light->specular[c] = (float)value;
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

// --- sum-stagnation -----------------------------------------------------------------------

// One light of 1, and then so many of 0.0004 (less than half the last place of 1 in half
// precision) that all are `lights`. All stand overhead, where each weight is 1.
static void faint_lights(struct sb_points *points, const struct sb_case_setting *setting,
                         double lights)
{
    (void)setting;
    sb_points_add(points);
    for (int i = 0; i < points->lights; i++)
        set_white(sb_points_light(points, points->count - 1, i), i == 0       ? 1
                                                                 : i < lights ? 0.0004
                                                                              : 0);
}

// The same lights in other orders: the bright one last, then shuffled.
static void permute(struct sb_points *points)
{
    struct sb_random random = sb_random_seed(11);
    const int last = points->lights - 1, first = points->count - 1;
    for (int order = 0; order < 4; order++) {
        sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        memcpy(light, sb_points_light(points, first, 0),
               (size_t)points->lights * sizeof *light);
        const int with =
            order == 0 ? 0 : (int)sb_random_below(&random, (uint64_t)last + 1);
        const struct sb_light bright = light[with];
        light[with] = light[last];
        light[last] = bright;
    }
}

static void many_lights(struct sb_points *points, const struct sb_case_setting *setting)
{
    faint_lights(points, setting, points->lights);
    permute(points);
    struct sb_random random = sb_random_seed(12);
    sb_points_add(points);
    for (int i = 0; i < points->lights; i++)
        set_white(sb_points_light(points, points->count - 1, i),
                  0.02 * sb_random_unit(&random));
    permute(points);
}

// --- multipass-8bit -----------------------------------------------------------------------

// So many passes, and sums of them: 2048 points, a table's height that every driver has.
static const struct {
    int passes, sums;
} pass_runs[] = {{128, 8}, {512, 2}};

// Faint light that adds up to at most 1, where 8 bits end: of 512 passes most have less than half a
// step of 1/255.
static void add_passes(struct sb_points *points, int passes, int sums)
{
    struct sb_random random = sb_random_seed(13);
    for (int sum = 0; sum < sums; sum++)
        for (int i = 0; i < passes; i++) {
            const double largest = 2.0 * (sum + 1) / sums / passes;
            sb_points_add(points);
            set_white(sb_points_light(points, points->count - 1, 0),
                      0.97 * largest * sb_random_unit(&random));
        }
}

static void passes(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    for (size_t i = 0; i < COUNT(pass_runs); i++)
        add_passes(points, pass_runs[i].passes, pass_runs[i].sums);
}

// The largest error of the sums of one run, in steps of 1/255.
static bool measure_passes(const struct sb_unit *unit,
                           const struct sb_case_setting *setting, size_t run,
                           double *worst, struct sb_error *err)
{
    const int count = pass_runs[run].passes;
    struct sb_points points;
    struct sb_points_truth truth = {0};
    struct sb_image sums = {0};
    sb_points_init(&points, setting->variant);
    add_passes(&points, count, pass_runs[run].sums);
    if (sb_case_precisions[setting->precision].half)
        sb_points_round(&points);
    const bool good = sb_unit_add(unit, &points, count, &sums, err);
    *worst = 0;
    sb_points_truth_make(&points, setting->variant, &truth);
    for (int sum = 0; good && sum < pass_runs[run].sums; sum++) {
        struct sb_vec3 right = {0};
        for (int i = 0; i < count; i++)
            right = sb_vec3_add(right, truth.colour[sum * count + i]);
        const float *told = sums.data + (size_t)sum * (size_t)sums.channels;
        const double error[] = {fabs(told[0] - right.x), fabs(told[1] - right.y),
                                fabs(told[2] - right.z)};
        for (int c = 0; c < 3; c++)
            if (!(255 * error[c] <= *worst))
                *worst = isfinite(error[c]) ? 255 * error[c] : INFINITY;
    }
    sb_points_truth_free(&truth);
    sb_image_free(&sums);
    sb_points_free(&points);
    return good;
}

static bool measure_target(const struct sb_case_env *env,
                           const struct sb_case_setting *setting,
                           const struct sb_variant *variant,
                           double worst[COUNT(pass_runs)], struct sb_error *err)
{
    struct sb_unit unit = {0};
    bool good = sb_case_unit_open(&unit, env, variant, err);
    for (size_t run = 0; good && run < COUNT(pass_runs); run++)
        good = measure_passes(&unit, setting, run, &worst[run], err);
    sb_unit_close(&unit);
    return good;
}

// What half floats make of the same: they round to nearest on some drivers, and cut off on others.
static void note_half_target(const struct sb_case_env *env, const struct sb_case *it,
                             const struct sb_case_setting *setting,
                             struct sb_outcome *outcome)
{
    struct sb_variant half;
    struct sb_error ignored = {0};
    double worst[COUNT(pass_runs)];
    if (sb_case_variant(env, it, setting->form, setting->precision, setting->vertex,
                        "target=rgba16f", &half, &ignored) &&
        measure_target(env, setting, &half, worst, &ignored))
        sb_text_printf(&outcome->note,
                       "target=rgba16f: %.3g steps off after %d passes, %.3g after %d",
                       worst[0], pass_runs[0].passes, worst[1], pass_runs[1].passes);
}

static bool run_passes(const struct sb_case_env *env, const struct sb_case *it,
                       const struct sb_case_setting *setting, struct sb_outcome *outcome,
                       struct sb_error *err)
{
    double worst[COUNT(pass_runs)];
    if (!measure_target(env, setting, setting->variant, worst, err)) {
        // GLES blends floats by EXT_float_blend only, and else fails at the draw.
        const bool no_blend = setting->form == SB_CASE_ROBUST && env->driver->caps.gles &&
                              err->status == SB_GL_ERROR;
        if (no_blend) {
            sb_text_printf(&outcome->note,
                           "no EXT_float_blend: rgba32f cannot be blended; ");
            note_half_target(env, it, setting, outcome);
        }
        return no_blend; // the verdict is "n/a" still
    }
    for (size_t run = 0; run < COUNT(pass_runs); run++)
        sb_outcome_measured(outcome, SB_FIGURE_ABSOLUTE, worst[run], 1);
    if (setting->form == SB_CASE_ROBUST)
        note_half_target(env, it, setting, outcome);
    return true;
}

// --- mask-multiply ------------------------------------------------------------------------

// The light does not light the surface, so that all of it is cut, and its factor is infinite. It is
// so near that an attenuation without a constant is, on the surface or behind it; or it stands at
// the horizon across from the eye, where in half precision attenuation times highlight is.
static void behind(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double depth[] = {0, 1e-25, 1e-24, 1e-23, 1e-7, 1e-3};
    for (size_t i = 0; i < COUNT(depth); i++) {
        sb_points_add(points);
        sb_points_light(points, points->count - 1, 0)->position[2] = (float)-depth[i];
    }
    for (int i = 0; i < 8; i++) {
        struct sb_point *point = sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        memcpy(light->position, (float[3]){-0.01f, 0, 0}, sizeof light->position);
        memcpy(point->eye, (float[3]){1, 0, 0.01f * (1 + (float)i)}, sizeof point->eye);
        point->material.shininess = 1000;
    }
    for (int p = 0; p < points->count; p++) {
        sb_points_light(points, p, 0)->constant = 0;
        sb_points_light(points, p, 0)->quadratic = 1;
    }
}

// --- nan-swallow --------------------------------------------------------------------------

// Lights of no reach, in windows that min() and max() close.
static void no_reach(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    for (int i = 0; i < 6; i++) {
        sb_points_add(points);
        struct sb_light *light = sb_points_light(points, points->count - 1, 0);
        light->range = i < 3 ? 0 : 1;
        light->position[2] = i % 3 == 0 ? 0 : 0.5f * (float)i;
    }
}

// --- gouraud-nan --------------------------------------------------------------------------

enum { SIDE = 7 }; // vertices a side of a square mesh

// Three vertices are bad, none on the rim: a normal of length 0, one whose square is no half float,
// and one with the light on it.
static void mesh_with_bad(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            struct sb_point *point = sb_points_add(points);
            struct sb_light *light = sb_points_light(points, points->count - 1, 0);
            point->position[0] = 0.25f * (float)x;
            point->position[1] = 0.25f * (float)y;
            memcpy(light->position, (float[3]){1, 1, 0}, sizeof light->position);
            memcpy(point->eye, (float[3]){0.5f, 0.5f, 2}, sizeof point->eye);
            if (x == 1 && y == 1)
                point->normal[2] = 0;
            if (x == 1 && y == 4)
                point->normal[2] = 1e-4f;
        }
}

// --- the table ----------------------------------------------------------------------------

enum { BOTH_STAGES = SB_IN_FRAGMENT | SB_IN_VERTEX };

// Where f_output is naive: a robust output makes 0 of a NaN, and would hide it.
static const struct sb_case rows[] = {
    {
        .id = "sum-stagnation",
        .help = "faint lights add nothing to a bright sum (256 of them: axes end there)",
        .formula = "sum += light",
        .source =
            "Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., ch. 4",
        .given = "point=256 attenuation=none model=lambert ambient=none f_output=naive",
        .form = {"", "p_sum=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        // Highp: 256 roundings of 2^-24. Two orders of the same lights are within 1/255 of each
        // other where each is within half of that.
        .criterion = {{SB_FIGURE_RELATIVE, SB_OF_COLOUR, 256 * 0x1p-24, 2 * 0x1p-11},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, 0.5}},
        .hdr = true,
        .points = many_lights,
        .scale = {"lights", "", 2, 256, faint_lights},
    },
    {
        .id = "multipass-8bit",
        .help = "passes that are blended in 8 bits lose what is below half a step",
        .formula = "target += light",
        .source = "OpenGL 4.6 core, 17.3.6: blending rounds to the target's format",
        .given = "point=1 attenuation=none model=lambert ambient=none f_output=naive",
        .form = {"target=rgba8", "target=rgba32f"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, 1}},
        .points = passes,
        .run = run_passes,
    },
    {
        .id = "mask-multiply",
        .help = "a factor of 0 does not cut what is infinite or NaN",
        .formula = "light * mask",
        .source = "GLSL 4.60, 8.3: mix() with a bool takes nothing of the other operand",
        // The guard alone is on trial: attenuation is naive in both forms, and that its raw value is
        // infinite counts for neither. A robust output would hide what the mask leaves.
        .given = "point=1 ambient=none specular_norm=energy f_attenuation=naive "
                 "f_output=naive",
        .form = {"guard=mask", "guard=branch"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_LEAKS, SB_OF_COLOUR, 0, 0}},
        .points = behind,
    },
    {
        .id = "nan-swallow",
        .help = "min, max and clamp hide a NaN here, and show it elsewhere",
        .formula = "min(d / r, 1)",
        .source = "GLSL 4.60, 8.3: which operand they return for NaN is undefined; "
                  "ValveResourceFormat #1207",
        .given = "point=1 attenuation=windowed model=lambert ambient=none f_output=naive",
        .form = {"f_attenuation=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}},
        .points = no_reach,
    },
    {
        .id = "gouraud-highlight",
        .help = "a highlight between vertices is lost where vertices are lit",
        .formula = "interpolation of c^n",
        .source = "Phong 1975, Illumination for computer generated pictures",
        .given = "point=4 width=64 height=64 target=rgba32f",
        .form = {"stage=vertex", "stage=fragment"},
        .precisions = SB_IN_HIGHP,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, NAN},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, NAN}},
        .run = sb_case_run_gouraud,
    },
    {
        .id = "gouraud-nan",
        .help = "a vertex that is NaN blackens all triangles around it",
        .formula = "interpolation of NaN",
        .source = "decentraland/godot-explorer #2929",
        .given = "point=1 stage=vertex",
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}},
        .keeps_inputs = true, // of half floats the middle normal would be another
        .points = mesh_with_bad,
    },
    {
        .id = "msaa-extrapolation",
        .help = "at pixel centres outside a triangle, light is extrapolated below 0",
        .formula = "interpolation without centroid",
        .source = "OpenGL 4.6 core, 14.6.1; GLSL 4.60, 4.5 (centroid)",
        .given = "dir=1 stage=vertex samples=4 target=rgba16f ambient=none width=64 "
                 "height=64 tessellation=16",
        .form = {"f_output=naive", ""},
        .precisions = SB_IN_HIGHP,
        .stages = SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, NAN},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, NAN}},
        .run = sb_case_run_extrapolation,
    },
    {
        .id = "contraction",
        .help = "compilers may fuse and reorder: bits differ between equal shaders",
        .formula = "a b + c",
        .source = "GLSL 4.60, 4.7.1 and 4.11 (precise)",
        .given = "dir=1 point=5 model=lambert ambient=none f_output=naive",
        // No formula is naive here, only a test that asks for equal bits of other shaders.
        .form = {NULL, ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = BOTH_STAGES,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, 2}},
        .run = sb_case_run_repeat,
    },
    {
        .id = "link-precision",
        .help = "a uniform of two precisions in two stages does not link",
        .formula = "uniform highp in one stage, uniform mediump in the other",
        .source = "GLSL ES 3.00, 4.5.3 and 9.2.2; flutter_scene #401",
        .given = "dir=1 point=2 spot=1 width=16 height=16",
        .form = {"", ""},
        .precisions = SB_IN_HIGHP,
        .stages = SB_IN_FRAGMENT,
        .run = sb_case_run_links,
        .holds = "on desktop GL, where the qualifiers mean nothing (GLSL 4.60, 4.7)",
    },
};

const struct sb_case_family sb_cases_accumulation = {
    "accumulation", "accumulation, masks, interpolation and the toolchain", rows,
    sizeof rows / sizeof *rows};
