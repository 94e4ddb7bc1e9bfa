// Vectors, normals and tangent frames.
#include "cases/case.h"

const struct sb_case_family sb_cases_vectors = {
    "vectors", "vectors, normals and tangent frames", NULL, 0};
