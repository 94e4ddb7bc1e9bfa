// UTF-8 as files and other programs want it.
#pragma once

#include <stdint.h>

#include "base/text.h"

#define SB_UTF8_REPLACEMENT "\xEF\xBF\xBD" // U+FFFD

// Steps over one code point of a text that goes on (RFC 3629, section 4) and returns it; what is
// none is one byte, and -1.
int32_t sb_utf8_next(const char **at);

// The text with U+FFFD for every byte that is no UTF-8.
void sb_utf8_add(struct sb_text *text, const char *string);
