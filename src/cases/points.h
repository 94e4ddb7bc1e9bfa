// A table of points with all that they are lit by: what a hard case asks the formulas about.
#pragma once

#include "image/image.h"
#include "reference/shade.h"
#include "scene/point.h"

enum { SB_POINT_LIGHTS_MAX = 256 };

struct sb_points {
    int lights;                                   // a point
    enum sb_light_type type[SB_POINT_LIGHTS_MAX]; // of each of these lights
    bool unified; // layout=unified: the table has the lights as that wants them
    struct sb_point *point;
    struct sb_light *light; // point after point
    int count, capacity;
};

// For the lights of a resolved variant. *points is overwritten; sb_points_free afterwards.
void sb_points_init(struct sb_points *points, const struct sb_variant *variant);
// An empty table for lights like these.
struct sb_points sb_points_like(const struct sb_points *points);
void sb_points_free(struct sb_points *points);

// Appends a point: at the origin, facing +z, seen from (0, 0, 1), of white diffuse and specular
// colour with shininess 32 and no ambient light, tangent +x, bitangent +y, white texels and a flat
// normal (0.5, 0.5, 1). Its lights: white, of intensity 1, in (0, 0, 1), shining towards -z into a
// cone of 30 degrees (inner 15), exponent 8, attenuation 1 + 0 d + 0 d^2, range 10; of area lights
// radius, half axis (along x) and half sides 0.1. Valid until the next one.
struct sb_point *sb_points_add(struct sb_points *points);
struct sb_light *sb_points_light(const struct sb_points *points, int point, int i);

// Rounds every float to the nearest binary16 number (ties to even; from 65520 on infinity), so that
// what is measured in half precision is not the rounding of its inputs. What follows from the
// angles of a cone is made again from the rounded angles, in binary32, as the upload makes it.
void sb_points_round(struct sb_points *points);
float sb_round_half(double value);

// Is every light and material one that scenes may have (sb_scene_validate)?
bool sb_points_validate(const struct sb_points *points, struct sb_error *err);

// The table as the program "rows" reads it; the caller frees it.
void sb_points_table(const struct sb_points *points, struct sb_image *table);

// --- what is right ------------------------------------------------------------------------

// In double, from the points' floats, by the reference's ideal model of the variant.
struct sb_points_truth {
    struct sb_ref_shade *shade; // a point
    struct sb_vec3 *colour;     // a point
    struct sb_ref_terms *terms; // a light of a point, point after point
};
void sb_points_truth_make(const struct sb_points *points,
                          const struct sb_variant *variant,
                          struct sb_points_truth *truth);
void sb_points_truth_free(struct sb_points_truth *truth);
