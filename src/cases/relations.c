// Relations between two pictures of which neither is known: what must not change when lights are
// reordered, when the scene is turned or scaled, or when an effect is switched off by its numbers.
// They need no reference, and so hold the reference's own mistakes against the shaders too.
#include <math.h>
#include <string.h>

#include "cases/judge.h"
#include "cases/scatter.h"

// The points on the other side of a relation: the same scatter, with the lights of the other
// side's variant, changed.
struct relation {
    const char *other; // assignments of the other side, over those of the case
    // Changes the points of each side. `one` and `other` hold equal points to begin with; their
    // lights are equal where both have one of that number and type.
    void (*change)(struct sb_points *one, struct sb_points *other);
};

static struct sb_light *light_of(struct sb_points *points, int p, int i)
{
    return sb_points_light(points, p, i);
}

// --- lists of lights ----------------------------------------------------------------------

static void reverse_lights(struct sb_points *one, struct sb_points *other)
{
    for (int p = 0; p < one->count; p++)
        for (int i = 0; i < one->lights; i++)
            *light_of(other, p, i) = *light_of(one, p, one->lights - 1 - i);
}

static void halve(float colour[3])
{
    for (int c = 0; c < 3; c++)
        colour[c] *= 0.5f;
}

// Light 0 becomes lights 0 and 1 of half its colours.
static void split_light(struct sb_points *one, struct sb_points *other)
{
    for (int p = 0; p < one->count; p++)
        for (int i = 0; i < 2; i++) {
            struct sb_light *light = light_of(other, p, i);
            *light = *light_of(one, p, 0);
            halve(light->ambient);
            halve(light->diffuse);
            halve(light->specular);
        }
}

// A second light that is there, and black.
static void blacken_second(struct sb_points *one, struct sb_points *other)
{
    (void)one;
    for (int p = 0; p < other->count; p++) {
        struct sb_light *light = light_of(other, p, 1);
        memset(light->ambient, 0, sizeof light->ambient);
        memset(light->diffuse, 0, sizeof light->diffuse);
        memset(light->specular, 0, sizeof light->specular);
        light->intensity = 0;
    }
}

// --- the whole scene ----------------------------------------------------------------------

// Every vector of a point and of a light that is a place or a way in the world.
static void map_vectors(struct sb_points *points, void (*map)(float v[3]))
{
    for (int p = 0; p < points->count; p++) {
        struct sb_point *point = &points->point[p];
        map(point->position);
        map(point->normal);
        map(point->eye);
        map(point->tangent);
        map(point->bitangent);
        for (int i = 0; i < points->lights; i++) {
            map(light_of(points, p, i)->position);
            map(light_of(points, p, i)->direction);
        }
    }
}

static void turn(float v[3]) // a quarter about x
{
    const float y = v[1];
    v[1] = -v[2];
    v[2] = y;
}

static void mirror(float v[3])
{
    v[0] = -v[0];
}

static void turn_scene(struct sb_points *one, struct sb_points *other)
{
    (void)one;
    map_vectors(other, turn);
    for (int i = 0; i < other->count * other->lights; i++) {
        float *extent = other->light[i].extent;
        const float y = extent[1];
        extent[1] = extent[2];
        extent[2] = y;
    }
}

static void mirror_scene(struct sb_points *one, struct sb_points *other)
{
    (void)one;
    map_vectors(other, mirror);
}

// A power of two: no float changes but in its exponent, so that only a formula with a constant of
// its own can tell.
#define UNITS 16.0f

static void scale_vector(float v[3])
{
    for (int c = 0; c < 3; c++)
        v[c] *= UNITS;
}

static void scale_units(struct sb_points *one, struct sb_points *other)
{
    (void)one;
    for (int p = 0; p < other->count; p++) {
        scale_vector(other->point[p].position);
        scale_vector(other->point[p].eye);
    }
    for (int i = 0; i < other->count * other->lights; i++) {
        struct sb_light *light = &other->light[i];
        scale_vector(light->position);
        scale_vector(light->extent);
        light->range *= UNITS;
        light->radius *= UNITS;
        light->linear /= UNITS;
        light->quadratic /= UNITS * UNITS;
        if (other->type[i % other->lights] == SB_LIGHT_AREA)
            scale_vector(light->direction);
    }
}

// --- effects that their numbers switch off ------------------------------------------------

// A cut-off of 180 degrees: no cone.
static void open_cone(struct sb_points *one, struct sb_points *other)
{
    (void)one;
    for (int i = 0; i < other->count * other->lights; i++)
        sb_light_set_cone(&other->light[i], SB_PI, SB_PI);
}

static void shrink_area(struct sb_points *one, struct sb_points *other)
{
    (void)one;
    for (int i = 0; i < other->count * other->lights; i++) {
        other->light[i].radius = 1e-6f;
        memset(other->light[i].direction, 0, sizeof other->light[i].direction);
        memset(other->light[i].extent, 0, sizeof other->light[i].extent);
    }
}

static void flatten_map(struct sb_points *one, struct sb_points *other)
{
    static const float flat[3] = {128 / 255.0f, 128 / 255.0f, 1};
    (void)one;
    for (int p = 0; p < other->count; p++)
        memcpy(other->point[p].texel[SB_MAP_NORMAL], flat, sizeof flat);
}

// --- the table ----------------------------------------------------------------------------

// clang-format off
#define RELATION(id, help, given, highp, half) \
    {id, help, "the same picture", "metamorphic relation", given, {NULL, ""}, \
     SB_IN_HIGHP | SB_IN_HALF, SB_IN_FRAGMENT, \
     {{SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, highp, half}}, .run = relate}
// clang-format on

static bool relate(const struct sb_case_env *env, const struct sb_case *it,
                   const struct sb_case_setting *setting, struct sb_outcome *outcome,
                   struct sb_error *err);

// Bounds in steps of 1/255. In half precision two pictures of one truth may each be off by what a
// sum of few lights is.
static const struct sb_case rows[] = {
    RELATION("light-order", "the order of the lights shows", "point=4 dir=0", 0.01, 2),
    RELATION("light-split", "a light and its two halves differ", "point=1", 0.01, 2),
    RELATION("light-black", "a light of no intensity shows", "point=1", 0.001, 0.5),
    RELATION("scene-turned", "a quarter turn of the whole scene shows",
             "dir=1 point=1 spot=1 area=1 area_shape=box", 0.01, 4),
    RELATION("scene-mirrored", "a mirrored scene is lit otherwise",
             "dir=1 point=1 spot=1 area=1 area_shape=capsule", 0.001, 0.5),
    RELATION("units-scaled", "other units of length show",
             "dir=1 point=1 spot=1 area=1 attenuation=polynomial", 0.01, 4),
    RELATION("cone-open", "a spot light without a cone is no point light", "point=1",
             0.01, 2),
    RELATION("area-vanishing", "an area light without extent is no point light",
             "point=1", 0.5, 2),
    RELATION("normal-map-flat", "a flat normal map shows", "point=1", 0.5, 0.5),
};
static const struct relation relations[] = {
    {"", reverse_lights},
    {"point=2", split_light},
    {"point=2", blacken_second},
    {"", turn_scene},
    {"", mirror_scene},
    {"", scale_units},
    {"point=0 spot=1 cone=smooth", open_cone},
    {"point=0 area=1", shrink_area},
    {"maps=normal", flatten_map},
};

enum { POINTS = 512, SEED = 20 };

static double difference(const struct sb_unit_told *one, const struct sb_unit_told *other,
                         int *point)
{
    double worst = 0;
    for (int p = 0; p < POINTS; p++)
        for (int c = 0; c < 3; c++) {
            const double off = fabs((double)sb_told_colour(one, p)[c] -
                                    (double)sb_told_colour(other, p)[c]);
            if (off <= worst)
                continue;
            worst = isnan(off) ? INFINITY : off;
            *point = p;
        }
    return 255 * worst;
}

static bool light_side(const struct sb_case_env *env, const struct sb_variant *variant,
                       const struct sb_points *points, struct sb_unit_told *told,
                       struct sb_error *err)
{
    struct sb_unit unit = {0};
    const bool good = sb_case_unit_open(&unit, env, variant, err) &&
                      sb_unit_light(&unit, points, 0, told, err);
    sb_unit_close(&unit);
    return good;
}

static void scatter_both(struct sb_points *one, struct sb_points *other, bool half)
{
    sb_points_scatter(one, POINTS, SEED);
    sb_points_scatter(other, POINTS, SEED);
    memcpy(other->point, one->point, POINTS * sizeof *one->point);
    const int common = one->lights < other->lights ? one->lights : other->lights;
    for (int p = 0; p < POINTS; p++)
        for (int i = 0; i < common; i++)
            *light_of(other, p, i) = *light_of(one, p, i);
    if (half) {
        sb_points_round(one);
        sb_points_round(other);
    }
}

static bool relate(const struct sb_case_env *env, const struct sb_case *it,
                   const struct sb_case_setting *setting, struct sb_outcome *outcome,
                   struct sb_error *err)
{
    const struct relation *relation = &relations[it - rows];
    struct sb_variant variant;
    struct sb_points one, other;
    struct sb_unit_told told = {0}, told_other = {0};
    if (!sb_case_variant(env, it, setting->form, setting->precision, setting->vertex,
                         relation->other, &variant, err))
        return false;
    sb_points_init(&one, setting->variant);
    sb_points_init(&other, &variant);
    scatter_both(&one, &other, sb_case_precisions[setting->precision].half);
    relation->change(&one, &other);
    const bool good = light_side(env, setting->variant, &one, &told, err) &&
                      light_side(env, &variant, &other, &told_other, err);
    if (good) {
        outcome->figure = SB_FIGURE_ABSOLUTE;
        outcome->of = SB_OF_COLOUR;
        outcome->measured = difference(&told, &told_other, &outcome->point);
        outcome->bound = sb_criterion_bound(&it->criterion[0], setting->precision);
        outcome->verdict =
            outcome->measured <= outcome->bound ? SB_VERDICT_PASS : SB_VERDICT_FAIL;
    }
    sb_unit_told_free(&told);
    sb_unit_told_free(&told_other);
    sb_points_free(&one);
    sb_points_free(&other);
    return good;
}

const struct sb_case_family sb_cases_relations = {
    "relations", "relations between pictures, without a reference", rows,
    sizeof rows / sizeof *rows};
