// Breaking points: how far a case that scales holds.
#pragma once

#include "cases/case.h"

struct sb_breaking {
    double
        holds_to; // the farthest from `scale.from`, along which all that was asked holds; NAN: not even there
    bool to_the_end;           // all that was asked holds
    struct sb_outcome outcome; // of the first that does not; note is the caller's to free
};
// Asks at 32 places along the scale, then twice at 32 between the last that holds and the first
// that does not: the result is a 32^-3 of the (logarithmic) scale from the true one, where there
// is one. False: it could not be asked; the error says why.
bool sb_case_break(const struct sb_case_env *env, const struct sb_case *it,
                   enum sb_case_form form, enum sb_case_precision precision, bool vertex,
                   struct sb_breaking *breaking, struct sb_error *err);
