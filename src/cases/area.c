// Area lights: the nearest point of one, and the one nearest to the reflected ray.
//
// A surface inside a light is at no distance from it, and a light without a direction lights nothing
// (docs/glsl.md, "What is computed"): what is asked of it is that nothing breaks.
#include <math.h>
#include <string.h>

#include "cases/unit.h"
#include "cases/judge.h"
#include "measure/explain.h"

// Light number 0 of a new point.
static struct sb_light *light_at(struct sb_points *points, double x, double y, double z)
{
    sb_points_add(points);
    struct sb_light *light = sb_points_light(points, points->count - 1, 0);
    light->position[0] = (float)x;
    light->position[1] = (float)y;
    light->position[2] = (float)z;
    return light;
}

static void put_half_axis(struct sb_light *light, double x, double y, double z)
{
    light->direction[0] = (float)x;
    light->direction[1] = (float)y;
    light->direction[2] = (float)z;
}

// --- sphere-centre ------------------------------------------------------------------------

// The eye looks down its own reflected ray, +z. Lights of three sizes, the last of which is no more
// than a point, pass the ray sideways, through the ray's very middle; then the surface goes
// through the middle of the light.
static void across_the_centre(struct sb_points *points,
                              const struct sb_case_setting *setting)
{
    (void)setting;
    static const float radius[] = {0.25f, 0.0625f, 0};
    for (int r = 0; r < 3; r++)
        for (int i = -16; i <= 16; i++)
            light_at(points, i / 64.0, 0, 2)->radius = radius[r];
    for (int i = -16; i <= 16; i++)
        light_at(points, 0, 0, i / 32.0)->radius = 0.25f;
}

// --- tube-parallel ------------------------------------------------------------------------

// A tube that makes this angle, in radians, with the reflected ray +z: around the ray, and beside it,
// where its near and far ends are seen in directions of their own.
static void at_angle(struct sb_points *points, const struct sb_case_setting *setting,
                     double angle)
{
    (void)setting;
    for (int beside = 0; beside < 2; beside++)
        for (int side = -1; side <= 1; side += 2)
            put_half_axis(light_at(points, 0.25 * beside, 0, 2), side * sin(angle), 0,
                          cos(angle));
}

// Beside the ray only from a thousandth on: below, which end is nearer hangs on the last digits
// of the input. A tube along the ray, and one of no length, are around it.
static void along_the_ray(struct sb_points *points, const struct sb_case_setting *setting)
{
    for (int i = 0; i < 10; i++)
        at_angle(points, setting, ldexp(1, -i));
    for (int i = 0; i < 5; i++)
        put_half_axis(light_at(points, 0, 0, 2), 0, 0, ldexp(1, -2 * i));
    put_half_axis(light_at(points, 0, 0, 2), 0, 0, 0);
}

// --- box-inside ---------------------------------------------------------------------------

static void in_a_box(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    for (int i = -16; i <= 16; i++) {
        struct sb_light *light = light_at(points, 0, i / 256.0, i / 32.0);
        for (int c = 0; c < 3; c++)
            light->extent[c] = 0.25f;
    }
}

// --- two shapes that must give the same ---------------------------------------------------

// Lights all around the half space above a surface.
static void around(struct sb_points *points, float radius, float half)
{
    for (int i = 0; i < 64; i++) {
        const double turn = 2.4 * i, height = (i + 0.5) / 64, far = 0.5 + i % 5;
        const double flat = far * sqrt(1 - height * height);
        struct sb_light *light =
            light_at(points, flat * cos(turn), flat * sin(turn), far * height);
        light->radius = radius;
        put_half_axis(light, half, 0, 0);
        for (int c = 0; c < 3; c++)
            light->extent[c] = radius;
        points->point[points->count - 1].material.shininess = 8;
        for (int c = 0; c < 3; c++) {
            points->point[points->count - 1].material.diffuse[c] = 0.5f;
            points->point[points->count - 1].material.specular[c] = 0.5f;
        }
    }
}

// What the case's variant, with `more` over it, makes of these lights.
static bool light_around(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting, const char *more,
                         const float size[2], struct sb_unit_told *told,
                         struct sb_error *err)
{
    struct sb_variant variant;
    struct sb_unit unit = {0};
    struct sb_points points;
    if (!sb_case_variant(env, it, setting->form, setting->precision, setting->vertex,
                         more, &variant, err))
        return false;
    const struct sb_unit_params params = {
        .axes = env->axes,
        .variant = &variant,
        .driver = env->driver,
        .data_dir = env->data_dir,
        .shaders = env->shaders,
        .id = sb_case_next_job(),
    };
    sb_points_init(&points, &variant);
    around(&points, size[0], size[1]);
    if (sb_case_precisions[setting->precision].half)
        sb_points_round(&points);
    const bool good =
        sb_unit_open(&unit, &params, err) && sb_unit_light(&unit, &points, 0, told, err);
    sb_points_free(&points);
    sb_unit_close(&unit);
    return good;
}

// What leaves a point: per vertex the diffuse and the specular light that it hands on.
static double leaves(const struct sb_unit_told *told, int point, bool vertex, int c)
{
    return sb_told_colour(told, point)[c] +
           (vertex ? sb_told_page(&told->frame, point)[c] : 0);
}

// The largest difference, in steps of 1/255, and the values that are not finite.
static void compare(const struct sb_unit_told told[2], bool vertex,
                    struct sb_outcome *outcome, double *nonfinite)
{
    const int count = told[0].inputs.width * told[0].inputs.height;
    for (int p = 0; p < count; p++) {
        *nonfinite += sb_told_page(&told[0].inputs, p)[8];
        for (int c = 0; c < 3; c++) {
            const double off = 255 * fabs(leaves(&told[0], p, vertex, c) -
                                          leaves(&told[1], p, vertex, c));
            if (off <= outcome->measured)
                continue;
            outcome->measured = isnan(off) ? INFINITY : off;
            outcome->point = p;
        }
    }
}

struct alike { // the first is on trial
    const char *words[2];
    float radius, half; // half sides of a box, too
};

static bool are_alike(const struct sb_case_env *env, const struct sb_case *it,
                      const struct sb_case_setting *setting, const struct alike *alike,
                      struct sb_outcome *outcome, struct sb_error *err)
{
    struct sb_unit_told told[2] = {0};
    const float size[2] = {alike->radius, alike->half};
    double nonfinite = 0;
    const bool good =
        light_around(env, it, setting, alike->words[0], size, &told[0], err) &&
        light_around(env, it, setting, alike->words[1], size, &told[1], err);
    if (good)
        compare(told, setting->vertex, outcome, &nonfinite);
    sb_unit_told_free(&told[0]);
    sb_unit_told_free(&told[1]);
    if (good && nonfinite > 0 && outcome->verdict == SB_VERDICT_PASS) {
        outcome->verdict = SB_VERDICT_FAIL;
        outcome->figure = SB_FIGURE_FINITE;
        outcome->measured = nonfinite;
        outcome->bound = 0;
    } else if (good && outcome->measured > outcome->bound) {
        outcome->verdict = SB_VERDICT_FAIL;
    }
    return good;
}

static void expect_alike(struct sb_outcome *outcome)
{
    outcome->verdict = SB_VERDICT_PASS;
    outcome->figure = SB_FIGURE_OWN;
    outcome->measured = 0;
    outcome->bound = 0.5; // steps of 1/255, in every precision
}

static bool run_capsule(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_outcome *outcome,
                        struct sb_error *err)
{
    static const struct alike ball = {
        {"area_shape=capsule", "area_shape=sphere"}, 0.25f, 0};
    expect_alike(outcome);
    return are_alike(env, it, setting, &ball, outcome, err);
}

static bool run_to_point(const struct sb_case_env *env, const struct sb_case *it,
                         const struct sb_case_setting *setting,
                         struct sb_outcome *outcome, struct sb_error *err)
{
    static const char point[] = "area=0 point=1";
    static const struct alike shapes[] = {
        {{"area_shape=sphere", point}, 1e-6f, 0},
        {{"area_shape=tube", point}, 0, 1e-6f},
        {{"area_shape=capsule", point}, 1e-6f, 1e-6f},
        {{"area_shape=box", point}, 1e-6f, 0},
    };
    expect_alike(outcome);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (outcome->verdict == SB_VERDICT_PASS &&
            !are_alike(env, it, setting, &shapes[i], outcome, err))
            return false;
    return true;
}

// --- the cases ----------------------------------------------------------------------------

static const struct sb_case rows[] = {
    {
        .id = "sphere-centre",
        .help = "a ray through the centre of a ball misses it by 0: radius / 0",
        .formula = "c = (L . R) R - L; L + c clamp(radius / |c|, 0, 1)",
        .source =
            "Karis 2013, Real Shading in Unreal Engine 4, equation 11; Godot #56373",
        .given = "area=1 area_shape=sphere model=phong attenuation=none ambient=none",
        .form = {"f_area=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, 1}},
        .points = across_the_centre,
    },
    {
        .id = "tube-parallel",
        .help = "a tube along the reflected ray has no nearest point: 0 / 0",
        .formula = "t = ((L . R)(A . R) - L . A) / (A . A - (A . R)^2)",
        .source = "Karis 2013, Real Shading in Unreal Engine 4, tube lights; Picott 1992",
        .given = "area=1 area_shape=tube model=phong attenuation=none ambient=none",
        .form = {"f_area=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 1, 1}},
        .points = along_the_ray,
        .scale = {"angle", "rad", 1, 1e-7, at_angle},
    },
    {
        .id = "capsule-degenerate",
        .help = "a capsule of no length: 0 / 0, which clamp() may hide",
        .formula = "t = P . A / (A . A)",
        .source = "Karis 2013, Real Shading in Unreal Engine 4",
        .given = "area=1 area_shape=capsule model=phong attenuation=none ambient=none",
        .form = {"f_area=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .run = run_capsule,
    },
    {
        .id = "box-inside",
        .help = "the nearest point of a box from inside is where one stands: L = 0 / 0",
        .formula = "L = D / |D| with D = clamp(P, -h, h) - P",
        .source =
            "Drobot 2014, Physically based area lights; Filament, light_punctual.fs",
        .given = "area=1 area_shape=box model=phong attenuation=none ambient=none",
        .form = {"f_unit=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0}},
        .points = in_a_box,
    },
    {
        .id = "area-to-point",
        .help = "an area light of a size of 1e-6 is a point light",
        .formula = "all shapes, against point lights",
        .source = "metamorphic: consistency as the radius goes to 0",
        .given = "area=1 model=phong attenuation=none ambient=none",
        .form = {"f_area=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .run = run_to_point,
    },
};

const struct sb_case_family sb_cases_area = {"area", "area lights", rows,
                                             sizeof rows / sizeof *rows};
