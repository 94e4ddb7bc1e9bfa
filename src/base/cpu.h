// What this processor says of itself: what a JIT in this process compiles for. A simulator shows
// another one than the machine has.
#pragma once

#include <stddef.h>

#include "base/text.h"

// The processor's own name, and the words of those vector features that it has and the system lets
// programs use, of sse4.1 up to AVX-512, with blanks between: "sse4.1 avx avx2 fma". Both empty
// where this is no x86; cut at `size`.
void sb_cpu_name(char *name, size_t size);
void sb_cpu_features(char *words, size_t size);

// Appends the words of `all` that `others` lacks, with blanks between.
void sb_cpu_lacking(const char *all, const char *others, struct sb_text *text);
