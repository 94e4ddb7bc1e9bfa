#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/text.h"

static void reserve(struct sb_text *text, size_t more)
{
    const size_t need = text->length + more + 1;
    if (need <= text->capacity)
        return;
    text->capacity = need > 2 * text->capacity ? need + 64 : 2 * text->capacity;
    text->data = sb_realloc(text->data, text->capacity);
}

void sb_text_add_n(struct sb_text *text, const char *bytes, size_t count)
{
    reserve(text, count);
    memcpy(text->data + text->length, bytes, count);
    text->length += count;
    text->data[text->length] = '\0';
}

void sb_text_add(struct sb_text *text, const char *string)
{
    sb_text_add_n(text, string, strlen(string));
}

void sb_text_vprintf(struct sb_text *text, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, args);
    reserve(text, (size_t)length);
    vsnprintf(text->data + text->length, (size_t)length + 1, format, again);
    va_end(again);
    text->length += (size_t)length;
}

void sb_text_printf(struct sb_text *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sb_text_vprintf(text, format, args);
    va_end(args);
}

void sb_text_number(struct sb_text *text, double value)
{
    char buffer[32];
    sb_text_add(text, sb_number_text(value, buffer));
}

const char *sb_text_get(const struct sb_text *text)
{
    return text->data ? text->data : "";
}

void sb_text_clear(struct sb_text *text)
{
    text->length = 0;
    if (text->data)
        text->data[0] = '\0';
}

void sb_text_free(struct sb_text *text)
{
    free(text->data);
    *text = (struct sb_text){0};
}

char *sb_number_text(double value, char buffer[static 32])
{
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(buffer, 32, "%.*g", digits, value);
        if (isnan(value) || strtod(buffer, NULL) == value)
            break;
    }
    // 3e+01 is 30 to a reader: prefer the plain form where it is as exact and not long.
    char plain[64];
    if (strchr(buffer, 'e') && fabs(value) < 1e6 && fabs(value) >= 1) {
        snprintf(plain, sizeof plain, "%.0f", value);
        if (strtod(plain, NULL) == value)
            memcpy(buffer, plain, strlen(plain) + 1);
    }
    return buffer;
}

bool sb_text_same(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

bool sb_parse_number(const char *text, double *value)
{
    // strtod would also take blanks, "inf", "nan" and hexadecimal.
    if (!*text || strspn(text, "+-.0123456789eE") != strlen(text))
        return false;
    char *end;
    errno = 0;
    const double number = strtod(text, &end);
    if (*end || !isfinite(number))
        return false;
    *value = number;
    return true;
}

int sb_text_width(const char *text)
{
    int width = 0;
    for (; *text; text++)
        width += ((unsigned char)*text & 0xC0) != 0x80;
    return width;
}
