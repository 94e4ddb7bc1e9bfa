// Random points for checks that want many ordinary ones.
#pragma once

#include "cases/points.h"

// Appends `count` points within half a unit of the origin, with normals within 45 degrees of +z,
// seen from above; all colours, materials and texels random; lights one to two units above, so
// that most points are lit by most lights.
void sb_points_scatter(struct sb_points *points, int count, uint64_t seed);
