// Matrices of doubles, column-major as GL takes them: m[4 * column + row].
#pragma once

#include "math/vec.h"

struct sb_mat3 {
    double m[9];
};

struct sb_mat4 {
    double m[16];
};

struct sb_mat4 sb_mat4_multiply(struct sb_mat4 a, struct sb_mat4 b);
struct sb_vec3 sb_mat4_transform_point(struct sb_mat4 m,
                                       struct sb_vec3 point); // affine m

struct sb_mat4 sb_mat4_translation(struct sb_vec3 by);
struct sb_mat4 sb_mat4_scaling(double by);

// Counter-clockwise by `angle` radians for whoever looks against `axis`; the axis must
// not be zero and need not be of unit length.
struct sb_mat4 sb_mat4_rotation(double angle, struct sb_vec3 axis);

// World to view: the eye goes to the origin and looks along -z at `target`; `up` must not
// be parallel to the way it looks.
struct sb_mat4 sb_mat4_look_at(struct sb_vec3 eye, struct sb_vec3 target,
                               struct sb_vec3 up);

// View to clip: near and far go to z/w = -1 and 1. fov_y is the whole vertical angle.
struct sb_mat4 sb_mat4_perspective(double fov_y, double aspect, double near, double far);

// What takes normals through the affine matrix m: the cofactor matrix of its upper 3x3
// times the sign of the determinant. That is the inverse transpose up to a positive
// factor, but exists for flattened models too, and mirrored ones keep their outside. The
// factor is chosen so that the longest column has length 1: a turned and evenly scaled
// model keeps normals of unit length, and no scale over- or underflows.
struct sb_mat3 sb_mat4_normal_matrix(struct sb_mat4 m);
