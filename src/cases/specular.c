// Specular power.
#include "cases/case.h"

const struct sb_case_family sb_cases_specular = {"specular", "specular power", NULL, 0};
