// Vectors of three doubles.
#pragma once

#include <math.h>

#define SB_PI 3.14159265358979323846

struct sb_vec3 {
    double x, y, z;
};

static inline struct sb_vec3 sb_vec3_add(struct sb_vec3 a, struct sb_vec3 b)
{
    return (struct sb_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline struct sb_vec3 sb_vec3_sub(struct sb_vec3 a, struct sb_vec3 b)
{
    return (struct sb_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct sb_vec3 sb_vec3_scale(struct sb_vec3 a, double s)
{
    return (struct sb_vec3){a.x * s, a.y * s, a.z * s};
}

static inline double sb_vec3_dot(struct sb_vec3 a, struct sb_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct sb_vec3 sb_vec3_cross(struct sb_vec3 a, struct sb_vec3 b)
{
    return (struct sb_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                            a.x * b.y - a.y * b.x};
}

// By sqrt, not hypot: sqrt is correctly rounded everywhere, so scenes hash the same.
static inline double sb_vec3_length(struct sb_vec3 a)
{
    return sqrt(sb_vec3_dot(a, a));
}

// a must not be zero.
static inline struct sb_vec3 sb_vec3_normalise(struct sb_vec3 a)
{
    return sb_vec3_scale(a, 1 / sb_vec3_length(a));
}
