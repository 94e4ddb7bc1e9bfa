// Shadow maps. What they hold and what lookups make of it is judged by rays in double through the
// same triangles.
#include <math.h>
#include <stdio.h>

#include "cases/face.h"
#include "cases/shadow_finding.h"

// --- acne-slope ---------------------------------------------------------------------------

// Pixels of a surface that nothing else shadows which do so themselves.
static bool shadows_itself(const struct sb_shadow_world *world,
                           struct sb_shadow_finding *found, struct sb_error *err)
{
    (void)err;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (!sb_shadow_pixel_at(world, i, &at))
            continue;
        sb_shadow_hold_to_truth(world, &at, found); // its back
        if (at.n_dot_l <= 0.05)                     // a NaN goes on
            continue;
        found->judged++;
        found->measured += !(isfinite(at.n_dot_l) && isfinite(at.shown) && at.shown >= 1);
    }
    return true;
}

static bool run_acne(const struct sb_case_env *env, const struct sb_case *it,
                     const struct sb_case_setting *setting, struct sb_outcome *outcome,
                     struct sb_error *err)
{
    (void)it;
    struct sb_shadow_finding found = {0};
    if (!sb_shadow_measure(env, setting->variant, "sphere", shadows_itself, &found, err))
        return false;
    sb_shadow_judge_shown(outcome, &found, 0, "pixels that shadow themselves");
    return true;
}

// --- peter-pan ----------------------------------------------------------------------------

// The widest gap, in texels, between an occluder and the shadow that it throws.
static bool widest_gap(const struct sb_shadow_world *world,
                       struct sb_shadow_finding *found, struct sb_error *err)
{
    (void)err;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (!sb_shadow_pixel_at(world, i, &at))
            continue;
        sb_shadow_hold_to_truth(world, &at, found);
        if (!isfinite(at.shown) || !isfinite(at.n_dot_l))
            found->measured = INFINITY;
        if (!(at.shown > 0 && at.n_dot_l > 0))
            continue;
        found->judged++;
        found->measured =
            sb_worse(found->measured, sb_shadow_gap(world, at.from_light) /
                                          sb_shadow_texel(world, at.from_light));
    }
    return true;
}

static bool run_gap(const struct sb_case_env *env, const struct sb_case *it,
                    const struct sb_case_setting *setting, struct sb_outcome *outcome,
                    struct sb_error *err)
{
    // A remedy that fits one map only is none.
    static const char *const size[] = {"shadow_size=512", "shadow_size=256"};
    struct sb_shadow_finding found = {0};
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        struct sb_variant variant;
        if (!sb_case_variant(env, it, setting->form, setting->precision, false, size[i],
                             &variant, err) ||
            !sb_shadow_measure(env, &variant, "blocks", widest_gap, &found, err))
            return false;
    }
    sb_shadow_judge_shown(outcome, &found, 2,
                          "texels between an occluder and its shadow");
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
static bool stored_error(const struct sb_shadow_world *world,
                         struct sb_shadow_finding *found, struct sb_error *err)
{
    struct sb_image map = {0};
    if (!sb_shadow_map_read(world, &map, err))
        return false;
    for (int i = 0; i < map.width * map.height; i++) {
        struct sb_vec3 d;
        if (!sb_shadow_map_direction(world, i % map.width, i / map.width, &d))
            continue;
        const double seen = sb_shadow_seen(world, d);
        if (seen >= world->range || near_an_outline(world, d, seen))
            continue;
        const double error = fabs((double)map.data[i] - (1 - seen / world->range));
        found->judged++;
        found->measured = sb_worse(found->measured, error / world->bias);
    }
    sb_image_free(&map);
    return true;
}

static bool run_store(const struct sb_case_env *env, const struct sb_case *it,
                      const struct sb_case_setting *setting, struct sb_outcome *outcome,
                      struct sb_error *err)
{
    struct sb_shadow_finding found = {0};
    if (!sb_shadow_measure(env, setting->variant, "room", stored_error, &found, err))
        return false;
    sb_shadow_judge(outcome, &found,
                    sb_criterion_bound(it->criterion, setting->precision),
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
        const int face = at[2] >= 0 && at[2] < 6 ? (int)at[2] : -1; // a NaN is none
        const float *d = direction[i];
        const float largest = fmaxf(fabsf(d[0]), fmaxf(fabsf(d[1]), fabsf(d[2])));
        const bool good = face >= 0 &&
                          (face % 2 ? -d[axis_of[face]] : d[axis_of[face]]) == largest &&
                          at[0] >= 0 && at[0] <= 1 && at[1] >= 0 && at[1] <= 1;
        homeless += !good;
    }
    return homeless;
}

// Is a place more than a texel away from the edges of its face?
static bool inside_a_face(const struct sb_shadow_world *world, struct sb_vec3 from_light)
{
    const double d[3] = {fabs(from_light.x), fabs(from_light.y), fabs(from_light.z)};
    const double largest = fmax(d[0], fmax(d[1], d[2]));
    const double least = fmin(d[0], fmin(d[1], d[2]));
    const double middle = d[0] + d[1] + d[2] - largest - least;
    return largest - middle > sb_shadow_texel(world, from_light);
}

// Pixels that six textures and a cube map shadow differently, but for those within a texel of an
// edge; and of both what is not as by the exact geometry, edges or not.
static bool kinds_differ(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting,
                         struct sb_shadow_finding *found, struct sb_error *err)
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
    for (int i = 0; good && i < sb_shadow_pixel_count(&world[0]); i++) {
        struct sb_shadow_pixel a, b;
        const bool in_a = sb_shadow_pixel_at(&world[0], i, &a);
        const bool in_b = sb_shadow_pixel_at(&world[1], i, &b);
        if (!in_a && !in_b)
            continue;
        found->judged++;
        if (in_a)
            sb_shadow_hold_to_truth(&world[0], &a, found);
        if (in_b)
            sb_shadow_hold_to_truth(&world[1], &b, found);
        found->measured += in_a != in_b || (!(a.shown == b.shown) &&
                                            inside_a_face(&world[0], a.from_light));
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
    struct sb_shadow_finding found = {.judged = count};
    if (!sb_faces_tell(env, setting->variant, (const float(*)[3])direction, count, &told,
                       err))
        return false;
    found.measured = count_homeless(&told, (const float(*)[3])direction, count);
    sb_image_free(&told);
    if (found.measured > 0) {
        sb_shadow_judge(outcome, &found, 0,
                        "directions that no face, or a wrong one, takes");
        return true;
    }
    found = (struct sb_shadow_finding){0};
    if (!kinds_differ(env, it, setting, &found, err))
        return false;
    sb_shadow_judge_shown(outcome, &found, 0,
                          "pixels that six textures and a cube map shadow differently");
    return true;
}

// --- beyond-range -------------------------------------------------------------------------

// Pixels that are farther from the light than it reaches, by more than rounding, and lit.
static bool lit_beyond(const struct sb_shadow_world *world,
                       struct sb_shadow_finding *found, struct sb_error *err)
{
    (void)err;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (!sb_shadow_pixel_at(world, i, &at) ||
            at.distance < world->range * (1 + 0x1p-9))
            continue;
        found->judged++;
        found->measured += !(at.shown == 0); // a NaN too
    }
    return true;
}

// Within the range, the light and the shadows that are there.
static bool shown_within(const struct sb_shadow_world *world,
                         struct sb_shadow_finding *found, struct sb_error *err)
{
    (void)err;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (sb_shadow_pixel_at(world, i, &at))
            sb_shadow_hold_to_truth(world, &at, found);
    }
    return true;
}

static bool run_beyond(const struct sb_case_env *env, const struct sb_case *it,
                       const struct sb_case_setting *setting, struct sb_outcome *outcome,
                       struct sb_error *err)
{
    // Each map and each store once: which of them a lookup goes to makes no difference to another.
    static const char *const pair[] = {
        "shadow_map=six2d shadow_store=r16f", "shadow_map=array2d shadow_store=depth",
        "shadow_map=cube shadow_store=r32f", "shadow_map=cube_array shadow_store=r8"};
    struct sb_shadow_finding found = {0};
    int asked = 0;
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++) {
        struct sb_variant variant, within;
        char fine[128]; // so that little of the room shadows itself
        snprintf(fine, sizeof fine, "%s shadow_size=256 shadow_bias_kind=slope", pair[i]);
        if (!sb_case_variant(env, it, setting->form, setting->precision, false, pair[i],
                             &variant, err) ||
            !sb_case_variant(env, it, setting->form, setting->precision, false, fine,
                             &within, err))
            return false;
        if (!sb_shadow_measure(env, &variant, "plane", lit_beyond, &found, err) ||
            !sb_shadow_measure(env, &within, "room", shown_within, &found, err)) {
            if (err->status != SB_OVER_LIMIT) // what a driver lacks is left out
                return false;
            sb_text_printf(&outcome->note, "%s; ", err->text);
            continue;
        }
        asked++;
    }
    if (asked == 0)
        return false;
    sb_shadow_judge_shown(outcome, &found, 0,
                          "lit pixels beyond the range, of all kinds of map and store");
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

static bool count_flips(const struct sb_shadow_world *world,
                        struct sb_shadow_finding *found, struct sb_error *err)
{
    (void)err;
    int flips = 0, far = 0;
    for (int i = 0; i < sb_shadow_pixel_count(world); i++) {
        struct sb_shadow_pixel at;
        if (!sb_shadow_pixel_at(world, i, &at) || at.distance >= world->range)
            continue;
        found->judged++;
        sb_shadow_hold_to_truth(world, &at, found);
        far += !isfinite(at.shown);
        if ((at.shown > 0.5) == passes(world, &at, 0, 0))
            continue;
        flips++;
        bool near = false;
        for (int n = 0; n < 9 && !near; n++)
            near = passes(world, &at, n % 3 - 1, n / 3 - 1) == (at.shown > 0.5);
        far += !near;
    }
    // A flip that no rounding explains is never right.
    found->measured = far > 0 ? 100 : 100.0 * flips / (found->judged ? found->judged : 1);
    return true;
}

static bool run_flip(const struct sb_case_env *env, const struct sb_case *it,
                     const struct sb_case_setting *setting, struct sb_outcome *outcome,
                     struct sb_error *err)
{
    (void)it;
    struct sb_shadow_finding found = {0};
    if (!sb_shadow_measure(env, setting->variant, "room", count_flips, &found, err))
        return false;
    sb_shadow_judge_shown(
        outcome, &found, 0.5,
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
        .help = "a bias in units of the range, large enough for slopes, takes shadows "
                "off their "
                "occluders",
        .formula = "1 - d/r + bias > stored",
        .source = "derived: the gap is bias r, whatever a texel is",
        // Small where the surface faces the light, and larger with the slope: 0.0015 as a
        // constant shadows 5 % of what is lit and dark, and 0 12 %. What it leaves open: it is
        // still a number of the scene, in units of the range. At 0.001 0.4 % are wrong
        // again, at 0.002 the widest gap is 5 texels.
        .given = CASTER "width=192 height=192",
        .form = {"shadow_bias=0.01", "shadow_bias_kind=slope shadow_bias=0.0015 " HIGH},
        BY_PIXEL,
        .run = run_gap,
    },
    {
        .id = "store-precision",
        .help = "8 bits hold a distance to 0.4 of a bias of 0.005, half floats of a "
                "smaller one",
        .formula = "stored = 1 - d/r",
        .source = "bgfx #3518; flutter_scene #237: a map read at half precision",
        // Half the default: of 0.01, half a step of r8 (1 / 510) is 20 %, which a quarter allows.
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
