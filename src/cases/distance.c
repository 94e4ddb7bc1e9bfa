// Distance, attenuation and range.
#include <math.h>

#include "cases/case.h"
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

static void on_surface(struct sb_points *points, const struct sb_case_setting *setting)
{
    (void)setting;
    static const double distance[] = {0, 0x1p-10, 0x1p-7, 0.01, 0.1, 1, 10};
    for (size_t i = 0; i < sizeof distance / sizeof *distance; i++)
        light_at(points, distance[i]);
}

// The law of distance: 1 / d^2 from 1/8 on, so that colours stay within 64.
static void at_distance(struct sb_points *points, const struct sb_case_setting *setting,
                        double distance)
{
    (void)setting;
    struct sb_light *light = light_at(points, distance);
    light->constant = 0;
    light->linear = 1;
}

static void far_away(struct sb_points *points, const struct sb_case_setting *setting)
{
    for (double d = 0x1p-10; d < 3e4; d *= 1.25)
        at_distance(points, setting, d);
}

static const struct sb_case rows[] = {
    {
        .id = "light-on-surface",
        .help = "a light on the surface has no direction: 0 / 0",
        .formula = "L = D / |D|",
        .source = "Filament, light_punctual.fs: getSquareFalloffAttenuation",
        .given = "point=1 attenuation=none model=lambert ambient=none",
        .form = {"form=naive", ""},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ABSOLUTE, SB_OF_COLOUR, 0.5, 2}},
        .points = on_surface,
    },
    {
        .id = "dist-overflow16",
        .help = "the square of a distance from 256 on leaves half precision",
        .formula = "L = D inversesqrt(D . D)",
        .source = "three.js #14752; Unity SRP #3141, #4911",
        .given = "point=1 model=lambert ambient=none",
        .form = {"form=naive", "p_position=highp p_attenuation=highp"},
        .precisions = SB_IN_HIGHP | SB_IN_HALF,
        .stages = SB_IN_FRAGMENT | SB_IN_VERTEX,
        .criterion = {{SB_FIGURE_FINITE, 0, 0, 0},
                      {SB_FIGURE_ANGLE, SB_TERM_direction, 0.1, 0.1},
                      {SB_FIGURE_RELATIVE, SB_TERM_attenuation, 1e-5, 4 * 0x1p-11}},
        .points = far_away,
        .scale = {"distance", "units", 1, 3e4, at_distance},
    },
};

const struct sb_case_family sb_cases_distance = {
    "distance", "distance, attenuation and range", rows, sizeof rows / sizeof *rows};
