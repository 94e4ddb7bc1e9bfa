// Directions and cones of the points of hard cases.
#pragma once

#include "cases/points.h"
#include "math/random.h"

// A unit vector, evenly over all of them.
struct sb_vec3 sb_any_direction(struct sb_random *random);

// A unit vector at `angle` (radians) from the unit vector `from`, turned any way around it.
struct sb_vec3 sb_turned(struct sb_random *random, struct sb_vec3 from, double angle);

// Appends a point that faces its light 0, a spot light at a distance of 2 whose axis, of any
// direction, the point is `angle` from. inner, outer: half angles of its cone, radians.
struct sb_light *sb_points_in_cone(struct sb_points *points, struct sb_random *random,
                                   double angle, double inner, double outer);
