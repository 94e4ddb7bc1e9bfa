// Accumulation, masks, interpolation and toolchain.
#include "cases/case.h"

const struct sb_case_family sb_cases_accumulation = {
    "accumulation", "accumulation, masks, interpolation and toolchain", NULL, 0};
