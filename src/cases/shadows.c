// Shadows.
#include "cases/case.h"

const struct sb_case_family sb_cases_shadows = {"shadows", "shadows", NULL, 0};
