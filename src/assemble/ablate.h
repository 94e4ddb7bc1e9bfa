// Leave-one-out: what each effect of a variant costs, and what is missing without it.
#pragma once

#include "suite/suite.h"

// Behind each entry that leaves nothing out puts the same without each effect that it calls for
// (axis `without`).
void sb_ablate(struct sb_suite *suite);
