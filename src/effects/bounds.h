// What a draw fills of the world, and what is known of its shape.
#pragma once

#include "math/vec.h"
#include "scene/scene.h"

// World space. All vertices lie in the box and in the sphere, which has the box's centre.
struct sb_bounds {
    struct sb_vec3 low, high, centre;
    double radius;
    // All of it lies in one plane, of which it shows one side: dot(normal, point) <= offset.
    bool flat;
    struct sb_vec3 normal;
    double offset;
};
void sb_bounds_of(const struct sb_scene *scene, int draw, struct sb_bounds *bounds);

// From a point to the box; 0 inside.
double sb_bounds_distance(const struct sb_bounds *bounds, struct sb_vec3 point);

// Does anything of the sphere lie within `angle` (radians, 0 to pi) of `axis` (unit length), as seen
// from `apex`? True where the apex is inside the sphere.
bool sb_bounds_in_cone(const struct sb_bounds *bounds, struct sb_vec3 apex,
                       struct sb_vec3 axis, double angle);

// May something in `other` stand between the point and something in `bounds`? Whether the sphere of
// `other` touches the hull of the point and the sphere of `bounds`, unless `bounds` is flat and all of
// `other` is behind it; conservative.
bool sb_bounds_between(const struct sb_bounds *bounds, struct sb_vec3 point,
                       const struct sb_bounds *other);

struct sb_shape_facts {
    bool
        even; // the normals of each triangle's vertices are equal: interpolation keeps their length
    bool
        convex; // no vertex lies in front of a triangle: it casts no shadow on its own lit side
};
void sb_shape_facts_of(const struct sb_mesh *mesh, struct sb_shape_facts *facts);

// Do normals of the mesh keep unit length in this draw's normal matrix, to 1e-6?
bool sb_draw_keeps_length(const struct sb_draw *draw);
