#include "base/utf8.h"

int32_t sb_utf8_next(const char **at)
{
    static const int32_t least[] = {0, 0x80, 0x800, 0x10000};
    const unsigned char *byte = (const unsigned char *)*at;
    const int more = byte[0] < 0x80                       ? 0
                     : byte[0] >= 0xC2 && byte[0] <= 0xDF ? 1
                     : byte[0] >= 0xE0 && byte[0] <= 0xEF ? 2
                     : byte[0] >= 0xF0 && byte[0] <= 0xF4 ? 3
                                                          : -1;
    int32_t code = more > 0 ? byte[0] & (0x3F >> more) : byte[0];
    ++*at;
    if (more < 0)
        return -1;
    for (int i = 1; i <= more; i++) {
        if ((byte[i] & 0xC0) != 0x80)
            return -1;
        code = code << 6 | (byte[i] & 0x3F);
    }
    if (code < least[more] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF))
        return -1;
    *at += more;
    return code;
}

void sb_utf8_add(struct sb_text *text, const char *string)
{
    for (const char *at = string; *at;) {
        const char *from = at;
        if (sb_utf8_next(&at) < 0)
            sb_text_add(text, SB_UTF8_REPLACEMENT);
        else
            sb_text_add_n(text, from, (size_t)(at - from));
    }
}
