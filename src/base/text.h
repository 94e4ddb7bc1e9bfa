// A growing string, and the few text functions that every layer needs. Nothing here (and
// nothing elsewhere) calls setlocale, so numbers are always written the C way.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// Zero-initialise, append, sb_text_free(). `data` is NULL while empty; sb_text_get is not.
struct sb_text {
    char *data;
    size_t length, capacity;
};
void sb_text_add(struct sb_text *text, const char *string);
void sb_text_add_n(struct sb_text *text, const char *bytes, size_t count);
void sb_text_printf(struct sb_text *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void sb_text_vprintf(struct sb_text *text, const char *format, __builtin_va_list args);
void sb_text_number(struct sb_text *text, double value); // shortest that reads back equal
const char *sb_text_get(const struct sb_text *text);     // never NULL
void sb_text_clear(struct sb_text *text);                // keeps the memory
void sb_text_free(struct sb_text *text);

// Shortest decimal form that strtod reads back as `value`; returns `buffer`.
char *sb_number_text(double value, char buffer[static 32]);

// A whole string as a finite number: false on empty, trailing bytes, inf, nan or overflow.
bool sb_parse_number(const char *text, double *value);

// Equal, or both NULL?
bool sb_text_same(const char *a, const char *b);

// Width of UTF-8 text in columns of a terminal, counting code points.
int sb_text_width(const char *text);
