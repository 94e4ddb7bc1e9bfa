// The formulas of the source texts, evaluated in double from what `run --dump` writes, and by
// nothing that the program itself draws or computes with. Of its code only the PFM reader is
// used.
//
// World space where nothing else is said; right-handed; colours are linear light.
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "image/image.h"

// --- vectors -----------------------------------------------------------------------------

struct vec {
    double x, y, z;
};
static inline struct vec add(struct vec a, struct vec b)
{
    return (struct vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline struct vec scaled(struct vec a, double k)
{
    return (struct vec){k * a.x, k * a.y, k * a.z};
}
static inline struct vec minus(struct vec a, struct vec b)
{
    return add(a, scaled(b, -1));
}
static inline struct vec times(struct vec a, struct vec b) // as GLSL's a * b
{
    return (struct vec){a.x * b.x, a.y * b.y, a.z * b.z};
}
static inline double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline struct vec cross(struct vec a, struct vec b)
{
    return (struct vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                        a.x * b.y - a.y * b.x};
}
static inline double length(struct vec a)
{
    return sqrt(dot(a, a));
}
static inline struct vec normalize(struct vec a)
{
    return scaled(a, 1 / length(a));
}
static inline struct vec reflect(struct vec incident, struct vec normal)
{
    return minus(incident, scaled(normal, 2 * dot(normal, incident)));
}
// By a column-major 4x4 matrix; w 1 for points, 0 for directions.
static inline struct vec transform(const double m[16], struct vec v, double w)
{
    return (struct vec){m[0] * v.x + m[4] * v.y + m[8] * v.z + m[12] * w,
                        m[1] * v.x + m[5] * v.y + m[9] * v.z + m[13] * w,
                        m[2] * v.x + m[6] * v.y + m[10] * v.z + m[14] * w};
}

// --- a dump ------------------------------------------------------------------------------

enum { LIGHTS_MAX = 16 };

struct dump_light { // 0 what its type does not have
    struct vec position, direction, ambient, diffuse, specular;
    double range, intensity, constant, linear, quadratic, cutoff, inner, exponent;
};
struct dump_lights {
    struct dump_light light[LIGHTS_MAX];
    int count;
};
struct dump_material {
    struct vec ambient, diffuse, specular;
    double shininess;
};
struct dump_corner { // of a triangle, placed in the world
    struct vec position, normal, tangent, bitangent;
    double u, v;
};
struct dump_draw {
    struct dump_corner *corner; // three a triangle
    int triangle_count;
    int material, lamp;
    struct vec centre; // of a ball around all corners
    double radius;
};
struct dump {
    struct sb_image colour, id, diffuse_map, specular_map, normal_map;
    bool has_diffuse_map, has_specular_map, has_normal_map; // that the variant samples
    bool as_written;
    struct vec eye, ambient;
    double view[16], view_projection[16], inverse[16]; // inverse of view_projection
    struct dump_lights dir, point, spot;
    struct dump_material *material;
    struct dump_draw *draw;
    int material_count, draw_count;
    double shadow_size, shadow_bias; // 0 where nothing casts a shadow
};
// Reads a folder; ends the test where it is not as docs/formats.md says.
void dump_read(struct dump *dump, const char *folder);
void dump_free(struct dump *dump);

// --- what a pixel shows ------------------------------------------------------------------

struct surface {
    int draw; // -1: nothing
    struct vec position;
    struct vec normal; // interpolated between unit normals, not of unit length itself
    struct vec tangent, bitangent; // likewise
    struct vec facet;              // unit normal of the triangle
    double u, v;
    const struct dump_material *material;
};
// What the ray through a point of the picture, in pixels from its lower left corner, meets
// first of the front sides of the triangles.
struct surface trace_pixel(const struct dump *dump, double x, double y);

// Is anything between the two points, further than `gap` from either? Both sides of triangles
// block. *nearest: the distance from `from` to what is met first.
bool trace_blocked(const struct dump *dump, struct vec from, struct vec to, double gap,
                   double *nearest);

// Bilinear, repeating; u = v = 0 is the lower left corner of the lower left texel.
struct vec texel(const struct sb_image *map, double u, double v);
// The map of the variant, or white.
struct vec diffuse_texel(const struct dump *dump, const struct surface *at);
struct vec specular_texel(const struct dump *dump, const struct surface *at);

// --- the formulas ------------------------------------------------------------------------

// What a formula decided on its way: two points that decide alike are lit by the same smooth
// function. `doubtful`: a decision that a shadow map of this size may take otherwise.
struct decisions {
    unsigned long long bits;
    bool doubtful;
};
static inline bool decide(struct decisions *made, bool yes)
{
    made->bits = made->bits * 3 + (yes ? 2 : 1);
    return yes;
}

typedef struct vec (*text_formula)(const struct dump *dump, const struct surface *at,
                                   bool as_written, struct decisions *made);
struct vec formula_delphi(const struct dump *dump, const struct surface *at,
                          bool as_written, struct decisions *made);
struct vec formula_wikibooks(const struct dump *dump, const struct surface *at,
                             bool as_written, struct decisions *made);
struct vec formula_lwjgl(const struct dump *dump, const struct surface *at,
                         bool as_written, struct decisions *made);
struct vec formula_ubo(const struct dump *dump, const struct surface *at, bool as_written,
                       struct decisions *made);
struct vec formula_shadows(const struct dump *dump, const struct surface *at,
                           bool as_written, struct decisions *made);
