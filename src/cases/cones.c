// Spot cones.
#include "cases/case.h"

const struct sb_case_family sb_cases_cones = {"cones", "spot cones", NULL, 0};
