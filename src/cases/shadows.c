// Shadow maps. What they hold and what lookups make of it is judged by rays in double through the
// same triangles.
#include <math.h>

#include "cases/face.h"
#include "cases/judge.h"
#include "cases/shadow_world.h"

// Sets the outcome: `measured` has to be at most `bound`.
static void judge(struct sb_outcome *outcome, double measured, double bound,
                  const char *unit)
{
    outcome->verdict = measured <= bound ? SB_VERDICT_PASS : SB_VERDICT_FAIL;
    outcome->figure = SB_FIGURE_OWN;
    outcome->measured = measured;
    outcome->bound = bound;
    sb_text_printf(&outcome->note, "%s", unit);
}

// A picture of a scene, and the figure of it.
static bool measure(const struct sb_case_env *env, const struct sb_variant *variant,
                    const char *scene,
                    bool (*figure)(const struct sb_shadow_world *, double *,
                                   struct sb_error *),
                    double *measured, struct sb_error *err)
{
    struct sb_shadow_world world = {0};
    const bool good = sb_shadow_world_open(&world, env, variant, scene, err) &&
                      figure(&world, measured, err);
    sb_shadow_world_close(&world);
    return good;
}

// --- acne-slope ---------------------------------------------------------------------------

// Pixels of a surface that nothing else shadows which do so themselves.
static bool shadows_itself(const struct sb_shadow_world *world, double *measured,
                           struct sb_error *err)
{
    (void)err;
    *measured = 0;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (sb_shadow_pixel_at(world, i, &at) && at.n_dot_l > 0.05)
            *measured += at.shown < 1;
    }
    return true;
}

static bool run_acne(const struct sb_case_env *env, const struct sb_case *it,
                     const struct sb_case_setting *setting, struct sb_outcome *outcome,
                     struct sb_error *err)
{
    (void)it;
    double measured;
    if (!measure(env, setting->variant, "sphere", shadows_itself, &measured, err))
        return false;
    judge(outcome, measured, 0, "pixels that shadow themselves");
    return true;
}

// --- peter-pan ----------------------------------------------------------------------------

// How far behind what the light sees first, along its ray. 0: nothing lies before it, or the edge of
// its shadow is within a texel, where what is lit says nothing of the bias.
static double gap_at(const struct sb_shadow_world *world, struct sb_vec3 from_light)
{
    double gap = INFINITY;
    for (int i = 0; i < 9; i++) {
        const struct sb_vec3 to =
            i == 4 ? from_light
                   : sb_shadow_centre(world, from_light, i % 3 - 1, i / 3 - 1);
        // To the plane through the place that faces the light's ray.
        const double along = sb_vec3_dot(to, from_light) / sb_vec3_length(to);
        gap = fmin(gap, along - sb_shadow_seen(world, to));
    }
    return fmax(gap, 0);
}

// The widest gap, in texels, between an occluder and the shadow that it throws.
static bool widest_gap(const struct sb_shadow_world *world, double *measured,
                       struct sb_error *err)
{
    (void)err;
    *measured = 0;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (sb_shadow_pixel_at(world, i, &at) && at.shown > 0 && at.n_dot_l > 0)
            *measured = fmax(*measured, gap_at(world, at.from_light) /
                                            sb_shadow_texel(world, at.from_light));
    }
    return true;
}

static bool run_gap(const struct sb_case_env *env, const struct sb_case *it,
                    const struct sb_case_setting *setting, struct sb_outcome *outcome,
                    struct sb_error *err)
{
    (void)it;
    double measured;
    if (!measure(env, setting->variant, "blocks", widest_gap, &measured, err))
        return false;
    judge(outcome, measured, 2, "texels between an occluder and its shadow");
    return true;
}

// --- store-precision, dist-interpolated ---------------------------------------------------

// Is an outline within a twentieth of a texel, where the rasteriser may see either side?
static bool near_an_outline(const struct sb_shadow_world *world, struct sb_vec3 d,
                            double seen)
{
    const double step = 0.1 / world->size;
    for (int i = 0; i < 6; i++) {
        const double off = i % 2 ? step : -step;
        const struct sb_vec3 to = {d.x + (i / 2 == 0) * off, d.y + (i / 2 == 1) * off,
                                   d.z + (i / 2 == 2) * off};
        const double other = sb_shadow_seen(world, to);
        if (!(fabs(other - seen) < 0.02 * world->range))
            return true;
    }
    return false;
}

// The largest error of what is stored, in biases, within the range of the light.
static bool stored_error(const struct sb_shadow_world *world, double *measured,
                         struct sb_error *err)
{
    struct sb_image map = {0};
    if (!sb_shadow_map_read(world, &map, err))
        return false;
    *measured = 0;
    for (int i = 0; i < map.width * map.height; i++) {
        struct sb_vec3 d;
        if (!sb_shadow_map_direction(world, i % map.width, i / map.width, &d))
            continue;
        const double seen = sb_shadow_seen(world, d);
        if (seen >= world->range || near_an_outline(world, d, seen))
            continue;
        *measured =
            fmax(*measured,
                 fabs((double)map.data[i] - (1 - seen / world->range)) / world->bias);
    }
    sb_image_free(&map);
    return true;
}

static bool run_store(const struct sb_case_env *env, const struct sb_case *it,
                      const struct sb_case_setting *setting, struct sb_outcome *outcome,
                      struct sb_error *err)
{
    double measured;
    if (!measure(env, setting->variant, "room", stored_error, &measured, err))
        return false;
    judge(outcome, measured, sb_criterion_bound(it->criterion, setting->precision),
          "biases that the stored distance is off");
    return true;
}

// --- cube-face-tie ------------------------------------------------------------------------

enum { TIES = 26, NUDGES = 27 };

// The axes, edges and corners of the cube, each with every component nudged by one unit in the last
// place: of the precision that directions have.
static int tie_directions(float direction[TIES * NUDGES][3], bool half)
{
    const float ulp = half ? 0x1p-11f : 0x1p-24f; // below 1
    int count = 0;
    for (int tie = 0; tie < 27; tie++)
        for (int nudge = 0; nudge < NUDGES; nudge++) {
            const int at[3] = {tie % 3 - 1, tie / 3 % 3 - 1, tie / 9 - 1};
            const int by[3] = {nudge % 3 - 1, nudge / 3 % 3 - 1, nudge / 9 - 1};
            if (tie == 13) // no direction
                continue;
            for (int c = 0; c < 3; c++) // above 1 the next number is two below it away
                direction[count][c] =
                    (float)at[c] * (1 + (by[c] > 0 ? 2 : 1) * (float)by[c] * ulp);
            count++;
        }
    return count;
}

// Directions without a face, with a wrong one or with a place outside of it. A component of the
// largest size is right, whichever of equal ones it is.
static double count_homeless(const struct sb_image *told, const float (*direction)[3],
                             int count)
{
    static const int axis_of[] = {0, 0, 1, 1, 2, 2};
    double homeless = 0;
    for (int i = 0; i < count; i++) {
        const float *at = told->data + (size_t)i * (size_t)told->channels + 4;
        const int face = (int)at[2];
        const float *d = direction[i];
        const float largest = fmaxf(fabsf(d[0]), fmaxf(fabsf(d[1]), fabsf(d[2])));
        const bool good = face >= 0 && face < 6 &&
                          (face % 2 ? -d[axis_of[face]] : d[axis_of[face]]) == largest &&
                          at[0] >= 0 && at[0] <= 1 && at[1] >= 0 && at[1] <= 1;
        homeless += !good;
    }
    return homeless;
}

// Pixels that six textures and a cube map shadow differently, but for those within a texel of an edge.
static bool kinds_differ(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting, double *pixels,
                         struct sb_error *err)
{
    struct sb_shadow_world world[2] = {0};
    bool good = true;
    static const char *const kind[] = {"shadow_map=six2d", "shadow_map=cube"};
    for (int i = 0; i < 2 && good; i++) {
        struct sb_variant variant;
        good = sb_case_variant(env, it, setting->form, setting->precision, false, kind[i],
                               &variant, err) &&
               sb_shadow_world_open(&world[i], env, &variant, "room", err);
    }
    *pixels = 0;
    for (int i = 0; good && i < sb_shadow_pixel_count(&world[0]); i++) {
        struct sb_shadow_pixel a, b;
        if (!sb_shadow_pixel_at(&world[0], i, &a) ||
            !sb_shadow_pixel_at(&world[1], i, &b) || a.shown == b.shown)
            continue;
        const double d[3] = {fabs(a.from_light.x), fabs(a.from_light.y),
                             fabs(a.from_light.z)};
        const double largest = fmax(d[0], fmax(d[1], d[2]));
        const double least = fmin(d[0], fmin(d[1], d[2]));
        const double middle = d[0] + d[1] + d[2] - largest - least;
        *pixels += largest - middle > sb_shadow_texel(&world[0], a.from_light);
    }
    sb_shadow_world_close(&world[0]);
    sb_shadow_world_close(&world[1]);
    return good;
}

static bool run_tie(const struct sb_case_env *env, const struct sb_case *it,
                    const struct sb_case_setting *setting, struct sb_outcome *outcome,
                    struct sb_error *err)
{
    static float direction[TIES * NUDGES][3];
    const int count =
        tie_directions(direction, sb_case_precisions[setting->precision].half);
    struct sb_image told = {0};
    double homeless, pixels;
    if (!sb_faces_tell(env, setting->variant, (const float(*)[3])direction, count, &told,
                       err))
        return false;
    homeless = count_homeless(&told, (const float(*)[3])direction, count);
    sb_image_free(&told);
    if (homeless > 0) {
        judge(outcome, homeless, 0, "directions that no face, or a wrong one, takes");
        return true;
    }
    if (!kinds_differ(env, it, setting, &pixels, err))
        return false;
    judge(outcome, pixels, 0,
          "pixels that six textures and a cube map shadow differently");
    return true;
}

// --- beyond-range -------------------------------------------------------------------------

// Pixels that are farther from the light than it reaches, by more than rounding, and lit.
static bool lit_beyond(const struct sb_shadow_world *world, double *measured,
                       struct sb_error *err)
{
    (void)err;
    int beyond = 0;
    *measured = 0;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (!sb_shadow_pixel_at(world, i, &at) ||
            at.distance < world->range * (1 + 0x1p-9))
            continue;
        beyond++;
        *measured += !(at.shown == 0); // a NaN too
    }
    return beyond > 0 || sb_fail(err, SB_BAD_INPUT, "nothing lies beyond the range");
}

static bool run_beyond(const struct sb_case_env *env, const struct sb_case *it,
                       const struct sb_case_setting *setting, struct sb_outcome *outcome,
                       struct sb_error *err)
{
    // Each map and each store once: which of them a lookup goes to makes no difference to another.
    static const char *const pair[] = {
        "shadow_map=six2d shadow_store=r16f", "shadow_map=array2d shadow_store=depth",
        "shadow_map=cube shadow_store=r32f", "shadow_map=cube_array shadow_store=r8"};
    double sum = 0;
    int asked = 0;
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++) {
        struct sb_variant variant;
        double measured;
        if (!sb_case_variant(env, it, setting->form, setting->precision, false, pair[i],
                             &variant, err))
            return false;
        if (!measure(env, &variant, "plane", lit_beyond, &measured, err)) {
            if (err->status != SB_OVER_LIMIT) // what a driver lacks is left out
                return false;
            sb_text_printf(&outcome->note, "%s; ", err->text);
            continue;
        }
        asked++;
        sum += measured;
    }
    if (asked == 0)
        return false;
    judge(outcome, sum, 0, "lit pixels beyond the range, of all kinds of map and store");
    return true;
}

// --- shadow-flip --------------------------------------------------------------------------

// Does a lookup of a map that holds exact distances let the light pass, x and y texels aside?
static bool passes(const struct sb_shadow_world *world, const struct sb_shadow_pixel *at,
                   int x, int y)
{
    const double seen =
        sb_shadow_seen(world, sb_shadow_centre(world, at->from_light, x, y));
    const double stored = isinf(seen) ? 0 : fmax(1 - seen / world->range, 0);
    return 1 - at->distance / world->range + world->bias > stored;
}

static bool count_flips(const struct sb_shadow_world *world, double *measured,
                        struct sb_error *err)
{
    (void)err;
    int flips = 0, far = 0, pixels = 0;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (!sb_shadow_pixel_at(world, i, &at) || at.distance >= world->range)
            continue;
        pixels++;
        if ((at.shown > 0.5) == passes(world, &at, 0, 0))
            continue;
        flips++;
        bool near = false;
        for (int n = 0; n < 9 && !near; n++)
            near = passes(world, &at, n % 3 - 1, n / 3 - 1) == (at.shown > 0.5);
        far += !near;
    }
    // A flip that no rounding explains is never right.
    *measured = far > 0 ? 100 : 100.0 * flips / fmax(pixels, 1);
    return true;
}

static bool run_flip(const struct sb_case_env *env, const struct sb_case *it,
                     const struct sb_case_setting *setting, struct sb_outcome *outcome,
                     struct sb_error *err)
{
    (void)it;
    double measured;
    if (!measure(env, setting->variant, "room", count_flips, &measured, err))
        return false;
    judge(outcome, measured, 0.5,
          "percent of pixels went the other way; 100: one of them not within a texel");
    return true;
}

// --- the cases ----------------------------------------------------------------------------

#define CASTER                                                                           \
    "dir=0 point=1 spot=0 area=0 shadows=1 model=lambert ambient=none attenuation=none " \
    "width=64 height=64 "
// What places and distances are made of.
#define HIGH     "p_position=highp p_attenuation=highp p_varying=highp p_uniform=highp"
#define BY_PIXEL .precisions = SB_IN_HIGHP | SB_IN_HALF, .stages = SB_IN_FRAGMENT

static const struct sb_case rows[] = {
    {
        .id = "acne-slope",
        .help =
            "a texel covers a depth that grows with the slope: a surface shadows itself",
        .formula = "1 - d/r + bias > stored",
        .source = "derived: (d / N) tan(theta) > bias r",
        // The range is 50, the distance 2: the bias is a hundredth of that distance.
        .given = CASTER "shadow_size=256 shadow_bias=0.0004 tessellation=40000",
        .form = {"shadow_bias_kind=constant", "shadow_bias_kind=slope " HIGH},
        BY_PIXEL,
        .run = run_acne,
    },
    {
        .id = "peter-pan",
        .help = "a bias in units of the range takes shadows off their occluders",
        .formula = "1 - d/r + bias > stored",
        .source = "derived: the gap is bias r, whatever a texel is",
        .given = CASTER "shadow_size=512 width=192 height=192",
        .form = {"shadow_bias=0.01", "shadow_bias=0.0015 " HIGH},
        BY_PIXEL,
        .run = run_gap,
    },
    {
        .id = "store-precision",
        .help = "8 bits, or half floats, hold a distance to a fifth of the bias",
        .formula = "stored = 1 - d/r",
        .source = "bgfx #3518; flutter_scene #237: a map read at half precision",
        .given = CASTER "shadow_size=64 shadow_bias=0.005",
        .form = {"shadow_store=r8", "shadow_store=r32f " HIGH},
        BY_PIXEL,
        .criterion = {{SB_FIGURE_OWN, 0, 0.25, 0.25}},
        .run = run_store,
    },
    {
        .id = "dist-interpolated",
        .help = "a distance is not linear over a triangle",
        .formula = "d = |P - L| per vertex, interpolated",
        .source = "derived: 41 % off in the middle of an edge seen under 90 degrees",
        .given = CASTER "shadow_size=64 shadow_bias=0.01 tessellation=200",
        .form = {"f_shadow=naive", HIGH},
        BY_PIXEL,
        .criterion = {{SB_FIGURE_OWN, 0, 0.1, 0.1}},
        .run = run_store,
    },
    {
        .id = "cube-face-tie",
        .help = "directions between faces: strict comparisons find none",
        .formula = "|x| > |y| && |x| > |z|, and so on",
        .source = "OpenGL 4.6 core, 8.13; Vulkan 1.3, cube map face selection",
        .given = CASTER "shadow_size=128",
        .form = {"f_shadow=naive", HIGH},
        BY_PIXEL,
        .run = run_tie,
    },
    {
        .id = "beyond-range",
        .help = "1 - d/r is negative beyond the range: formats disagree",
        .formula = "stored = 1 - d/r",
        .source = "OpenGL 4.6 core, 2.3.5: unsigned normalised formats are clamped",
        .given = CASTER "shadow_size=64",
        .form = {"f_shadow=naive", ""},
        BY_PIXEL,
        .run = run_beyond,
    },
    {
        .id = "shadow-flip",
        .help = "the two passes compute a distance differently: the comparison is noise",
        .formula = "1 - d/r + bias > stored",
        .source = "GLSL 4.60, 4.8: precise and invariant",
        .given = CASTER "shadow_size=128",
        .form = {"f_shadow=naive", HIGH},
        BY_PIXEL,
        .run = run_flip,
    },
};

const struct sb_case_family sb_cases_shadows = {"shadows", "shadow maps", rows,
                                                sizeof rows / sizeof *rows};
