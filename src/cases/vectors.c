// Vectors, normals and tangent frames: the table, and the points of the plain cases.
#include "cases/vectors.h"

#include <math.h>

#include "cases/judge.h"
#include "measure/explain.h"

// --- points -------------------------------------------------------------------------------

static void put(float *out, struct sb_vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

struct sb_point *sb_vectors_add(struct sb_points *points,
                                const struct sb_vectors_point *vectors)
{
    struct sb_point *point = sb_points_add(points);
    put(point->normal, vectors->normal);
    put(point->eye, vectors->eye);
    put(sb_points_light(points, points->count - 1, 0)->position, vectors->light);
    return point;
}

struct sb_vec3 sb_vectors_across(struct sb_vec3 v)
{
    const struct sb_vec3 axis = {fabs(v.x) < 0.5, fabs(v.x) >= 0.5, 0};
    return sb_vec3_normalise(sb_vec3_cross(v, axis));
}

static const struct sb_vec3 ahead = {0, 0, 1};
static const struct sb_vec3 slanted = {2.0 / 7, 3.0 / 7, 6.0 / 7};
static const struct sb_vec3 mirrored = {-2.0 / 7, -3.0 / 7, 6.0 / 7};

static struct sb_vec3 mirror(struct sb_vec3 v, struct sb_vec3 normal)
{
    const double along = 2 * sb_vec3_dot(v, normal);
    return sb_vec3_sub(sb_vec3_scale(normal, along), v);
}

// --- lengths of normals -------------------------------------------------------------------

static void add_normal(struct sb_points *points, struct sb_vec3 normal)
{
    sb_vectors_add(points, &(struct sb_vectors_point){normal, slanted, mirrored});
}

static void short_normals(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double length[] = {0, 0x1p-6, 0x1p-3, 0.5, 1, 4};
    for (size_t i = 0; i < sizeof length / sizeof *length; i++) {
        add_normal(points, sb_vec3_scale(ahead, length[i]));
        add_normal(points, sb_vec3_scale(slanted, length[i]));
    }
}

// Along an edge between a normal and its opposite; the squares of the shortest but one, 2^-6 long,
// are normal numbers in half precision.
static void opposite_normals(struct sb_points *points,
                             const struct sb_case_setting *setting)
{
    (void)setting;
    const struct sb_vec3 end[] = {ahead, slanted, mirrored};
    static const double share[] = {0, 0.25, 0.5 - 0x1p-7, 0.5, 0.5 + 0x1p-7, 0.75, 1};
    for (size_t e = 0; e < sizeof end / sizeof *end; e++)
        for (size_t i = 0; i < sizeof share / sizeof *share; i++) {
            const struct sb_vec3 back = sb_vec3_scale(end[e], -1);
            add_normal(points, sb_vec3_add(sb_vec3_scale(end[e], 1 - share[i]),
                                           sb_vec3_scale(back, share[i])));
        }
}

// Half way between two unit normals `degrees` apart, turned a little about both axes.
static void between_normals(struct sb_points *points,
                            const struct sb_case_setting *setting, double degrees)
{
    (void)setting;
    const double half = degrees * SB_PI / 360;
    for (int i = -2; i <= 2; i++)
        for (int j = -2; j <= 2; j++) {
            const double x = 0.1 * i, y = 0.1 * j;
            const struct sb_vec3 middle = sb_vec3_normalise((struct sb_vec3){x, y, 1});
            add_normal(points, sb_vec3_scale(middle, cos(half)));
        }
}

static void interpolated_normals(struct sb_points *points,
                                 const struct sb_case_setting *setting)
{
    static const double degrees[] = {10, 20, 45};
    for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++)
        between_normals(points, setting, degrees[i]);
}

// --- highlights ---------------------------------------------------------------------------

// The eye opposite the light, which is in front of the surface or behind it.
static void opposite_eyes(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    struct sb_random random = sb_random_seed(17);
    for (int i = 0; i < 64; i++) {
        const struct sb_vec3 light = sb_any_direction(&random);
        const struct sb_vec3 eye = sb_vec3_scale(light, i % 2 ? -1 : -2);
        sb_vectors_add(points, &(struct sb_vectors_point){ahead, light, eye});
    }
}

// The eye where the mirror image of the light is.
static void mirror_eyes(struct sb_points *points, const struct sb_case_setting *setting,
                        double exponent)
{
    (void)setting;
    struct sb_random random = sb_random_seed(19);
    for (int i = 0; i < 256; i++) {
        const struct sb_vec3 normal = sb_any_direction(&random);
        struct sb_vec3 light = sb_any_direction(&random);
        if (sb_vec3_dot(light, normal) < 0)
            light = sb_vec3_scale(light, -1);
        sb_vectors_add(points,
                       &(struct sb_vectors_point){normal, light, mirror(light, normal)})
            ->material.shininess = (float)exponent;
    }
}

static void peaks(struct sb_points *points, const struct sb_case_setting *setting)
{
    static const double exponent[] = {64, 256, 1024};
    for (size_t i = 0; i < sizeof exponent / sizeof *exponent; i++)
        mirror_eyes(points, setting, exponent[i]);
}

// --- coordinates --------------------------------------------------------------------------

// Around a place `far` from the origin along each axis.
static void far_places(struct sb_points *points, const struct sb_case_setting *setting,
                       double far)
{
    (void)setting;
    static const double step[] = {0.25, -0.25, 0.125, 0.375, 0.5};
    for (size_t i = 0; i < sizeof step / sizeof *step; i++) {
        const struct sb_vec3 at = {far + step[i], far - step[i], far + 2 * step[i]};
        struct sb_point *point = sb_vectors_add(
            points, &(struct sb_vectors_point){ahead, sb_vec3_add(at, slanted),
                                               sb_vec3_add(at, mirrored)});
        put(point->position, at);
    }
}

static void thousand(struct sb_points *points, const struct sb_case_setting *setting)
{
    far_places(points, setting, 1000);
}

// --- what is no table of points -----------------------------------------------------------

void sb_vectors_judge(const struct sb_criterion *criterion,
                      const struct sb_case_setting *setting, double measured,
                      struct sb_outcome *outcome)
{
    outcome->figure = criterion->figure;
    outcome->of = criterion->of;
    outcome->bound = sb_criterion_bound(criterion, setting->precision);
    outcome->measured = measured;
    outcome->verdict = measured <= outcome->bound ? SB_VERDICT_PASS : SB_VERDICT_FAIL;
}

// --- the table ----------------------------------------------------------------------------

// What half precision leaves of Lambert's law: 9 roundings of 2^-11, 1.1 steps. Where the catalogue
// asks for 0.5 steps it means floats.
#define LAMBERT_IN_HALF 1.1
// Errors of normal matrices: 1e-5 rad.
#define TINY_ANGLE (1e-5 * 180 / SB_PI)

#define PLAIN "point=1 attenuation=none ambient=none"

static const struct sb_case rows[] = {
    {
        .id = "zero-normal",
        .help = "a normal of length 0, of a cone's tip or a collapsed triangle",
        .formula = "N / |N|",
        .source = "Bevy #10905",
        .given = PLAIN " emulate_subnormals=flush",
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        // The fallback is for zero only: other normals keep their direction.
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ANGLE, SB_OF_NORMAL, 0.1, 0.1}},
        .points = short_normals,
    },
    {
        .id = "normal-shortening",
        .help = "interpolation shortens a normal by cos(angle / 2)",
        .formula = "N = (1 - t) N0 + t N1",
        .source = "Phong 1975",
        .given = PLAIN,
        .form = {"normalise=off", "normalise=on"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        // The ideal model renormalises, so that what is left out is an error. The power's bound in
        // half precision is that of spec-pow-16.
        .criterion = {{SB_FIGURE_ABSOLUTE, SB_TERM_n_dot_l, 0.5, LAMBERT_IN_HALF},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_specular, 0.5, 1.5}},
        .points = interpolated_normals,
        .scale = {"angle between normals", "degrees", 1, 170, between_normals},
    },
    {
        .id = "antipodal-normals",
        .help = "opposite normals interpolate to a normal of length 0",
        .formula = "N = (N0 + N1) / 2, N1 = -N0",
        .source = "as zero-normal",
        .given = PLAIN,
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ANGLE, SB_OF_NORMAL, 0.1, 0.1}},
        .points = opposite_normals,
    },
    {
        .id = "normal-nonuniform",
        .help = "normals of a stretched model turn the wrong way",
        .formula = "mat3(M) N",
        .source = "OpenGL 2.1, 2.11.3: normals go by the inverse",
        .form = {"", ""},
        .criterion = {{SB_FIGURE_ANGLE, SB_OF_NORMAL, TINY_ANGLE, NAN}},
        .run = sb_vectors_nonuniform,
        .on_cpu = true,
    },
    {
        .id = "normal-singular",
        .help = "normals of flattened and of mirrored models",
        .formula = "transpose(inverse(mat3(M))) N",
        .source = "Filament #3105",
        .form = {"", ""},
        .criterion = {{SB_FIGURE_FINITE, 0, 0, NAN}},
        .run = sb_vectors_singular,
        .on_cpu = true,
    },
    {
        .id = "tbn-parallel",
        .help = "a tangent of length 0, or along the normal",
        .formula = "mat3(T / |T|, B / |B|, N), B = N x T",
        .source = "mikktspace #30 (gltf-rs); Wicked Engine #117",
        .given = PLAIN " maps=normal",
        .form = {"f_frame=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        // Flat frames are lit as without a normal map.
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_n_dot_l, 0.5, LAMBERT_IN_HALF}},
        .points = sb_vectors_flat_frames,
    },
    {
        .id = "normalmap-z",
        .help = "x and y of a normal map may be longer than 1",
        .formula = "z = sqrt(1 - x^2 - y^2)",
        .source = "BC5, and filtering",
        .given = PLAIN " maps=normal normal_store=rg",
        .form = {"f_frame=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ANGLE, SB_OF_NORMAL, 0.1, 0.1}},
        .points = sb_vectors_long_bumps,
    },
    {
        .id = "normalmap-flat",
        .help = "the flat texel of 8 bits, 128, tilts the normal by 0.32 degrees",
        .formula = "2 texel - 1",
        .source = "OpenGL 4.6 core, 2.3.5: unsigned numbers have no middle",
        .given = PLAIN " maps=normal",
        .form = {"f_frame=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        // The power's bound in half precision is that of spec-pow-16 at n = 256.
        .criterion = {{SB_FIGURE_ABSOLUTE, SB_TERM_specular, 0.5, 3},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_n_dot_l, 0.5, LAMBERT_IN_HALF}},
        .points = sb_vectors_flat_bumps,
    },
    {
        .id = "half-vector-zero",
        .help = "light and view vectors that are opposite have no half vector",
        .formula = "H = (L + V) / |L + V|",
        .source = "Blinn 1977",
        .given = PLAIN,
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_LEAKS, SB_TERM_specular, 0, 0}},
        .points = opposite_eyes,
    },
    {
        .id = "reflect-nonunit",
        .help = "rounding lifts a cosine over 1, and the power multiplies it",
        .formula = "(R . V)^n",
        .source = "Phong 1975, rounded",
        .given = PLAIN " model=phong",
        .form = {"f_highlight=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        // The bounds of spec-pow-32, and of spec-pow-16 for its smallest exponents.
        .criterion = {{SB_FIGURE_EXCESS, SB_TERM_specular, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_TERM_specular, 0.1, 1.5}},
        .points = peaks,
        .scale = {"exponent", "", 1, 1e5, mirror_eyes},
    },
    {
        .id = "large-world",
        .help = "far from the origin of the world, differences of positions cancel",
        .formula = "L = P_light - P, in world space",
        .source = "Cozzi and Ring 2011, \"3D Engine Design for Virtual Globes\", 5",
        .given = PLAIN " width=64 height=64",
        .form = {"space=world", "space=eye"},
        .precisions = SB_IN_HIGHP,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, NAN}},
        .run = sb_vectors_far_world,
    },
    {
        .id = "world-pos-16",
        .help = "at a coordinate of 1000, half floats are 0.5 apart",
        .formula = "L = P_light - P, in mediump",
        .source = "Godot #86275",
        .given = PLAIN " model=lambert",
        .form = {"", "p_position=highp p_varying=highp p_uniform=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, 2}},
        .keeps_inputs = true,
        .points = thousand,
        .scale = {"coordinate", "units", 1, 1e5, far_places},
    },
    {
        .id = "fragcoord-16",
        .help = "half floats tell texels of a map of 2048 apart up to its middle only",
        .formula = "floor(2048 uv)",
        .source = "GLSL ES 1.00, 7.2: mediump vec4 gl_FragCoord",
        .given = PLAIN,
        .form = {"", "p_varying=highp"},
        .precisions = SB_IN_HALF,
        .stages = SB_IN_FRAGMENT,
        .criterion = {{SB_FIGURE_FLIPS, SB_OF_COLOUR, NAN, 0}},
        .run = sb_vectors_lookups,
        .keeps_inputs = true,
        .holds = "where a driver keeps mediump coordinates in 32 bits, as llvmpipe does; "
                 "emulated half precision does not",
    },
};

const struct sb_case_family sb_cases_vectors = {
    "vectors", "vectors, normals and tangent frames", rows, sizeof rows / sizeof *rows};
