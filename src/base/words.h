// Words that a user types: the valid one that is meant, and the message when there is none.
#pragma once

#include "base/error.h"

// The candidate most like `word` (edit distance at most a third of its length), or NULL.
const char *sb_nearest_word(const char *word, const char *const *candidates, int count);

// Fails with `stage: unknown value "vretex"; did you mean "vertex"? valid: fragment vertex`, where
// `owner` is "stage" ("": nothing stands before "unknown") and `what` is "value".
bool sb_fail_unknown(struct sb_error *err, const char *owner, const char *what,
                     const char *word, const char *const *valid, int count);
