// Area lights.
#include "cases/case.h"

const struct sb_case_family sb_cases_area = {"area", "area lights", NULL, 0};
