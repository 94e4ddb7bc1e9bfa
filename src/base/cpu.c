#include "base/cpu.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#if defined __x86_64__ || defined __i386__
#include <cpuid.h>

enum { EAX, EBX, ECX, EDX };
enum { SYSTEM_KEEPS_YMM = 0x06, SYSTEM_KEEPS_ZMM = 0xe6 }; // of XCR0

// Intel, "Software Developer's Manual", vol. 2A, CPUID.
static const struct feature {
    const char *word;
    unsigned leaf;
    int place, bit;
    unsigned kept; // bits of XCR0 without which programs must not use it
} features[] = {
    {"sse4.1", 1, ECX, 19, 0},
    {"sse4.2", 1, ECX, 20, 0},
    {"avx", 1, ECX, 28, SYSTEM_KEEPS_YMM},
    {"f16c", 1, ECX, 29, SYSTEM_KEEPS_YMM},
    {"fma", 1, ECX, 12, SYSTEM_KEEPS_YMM},
    {"avx2", 7, EBX, 5, SYSTEM_KEEPS_YMM},
    {"avx512f", 7, EBX, 16, SYSTEM_KEEPS_ZMM},
    {"avx512dq", 7, EBX, 17, SYSTEM_KEEPS_ZMM},
    {"avx512cd", 7, EBX, 28, SYSTEM_KEEPS_ZMM},
    {"avx512bw", 7, EBX, 30, SYSTEM_KEEPS_ZMM},
    {"avx512vl", 7, EBX, 31, SYSTEM_KEEPS_ZMM},
};

static bool ask(unsigned leaf, unsigned answer[4])
{
    return __get_cpuid_count(leaf, 0, &answer[EAX], &answer[EBX], &answer[ECX],
                             &answer[EDX]);
}

static unsigned kept_by_system(void)
{
    enum { OSXSAVE = 27 };
    unsigned answer[4], low = 0, high = 0;
    if (ask(1, answer) && answer[ECX] >> OSXSAVE & 1)
        __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

static bool has(const struct feature *feature, unsigned kept)
{
    unsigned answer[4];
    return (kept & feature->kept) == feature->kept && ask(feature->leaf, answer) &&
           (answer[feature->place] >> feature->bit & 1);
}

void sb_cpu_features(char *words, size_t size)
{
    const unsigned kept = kept_by_system();
    struct sb_text text = {0};
    for (size_t i = 0; i < sizeof features / sizeof *features; i++)
        if (has(&features[i], kept))
            sb_text_printf(&text, "%s%s", text.length ? " " : "", features[i].word);
    snprintf(words, size, "%s", sb_text_get(&text));
    sb_text_free(&text);
}

void sb_cpu_name(char *name, size_t size)
{
    char brand[3 * 16 + 1] = "";
    for (unsigned i = 0; i < 3; i++) {
        unsigned answer[4];
        if (!ask(0x80000002 + i, answer))
            break;
        memcpy(brand + (size_t)16 * i, answer, 16);
    }
    const char *begin = brand + strspn(brand, " ");
    size_t length = strlen(begin);
    while (length > 0 && begin[length - 1] == ' ')
        length--;
    snprintf(name, size, "%.*s", (int)length, begin);
}

#else

void sb_cpu_features(char *words, size_t size)
{
    snprintf(words, size, "%s", "");
}

void sb_cpu_name(char *name, size_t size)
{
    snprintf(name, size, "%s", "");
}

#endif

static bool holds(const char *words, const char *word, size_t length)
{
    for (; *words; words += strspn(words, " ")) {
        const size_t this = strcspn(words, " ");
        if (this == length && strncmp(words, word, length) == 0)
            return true;
        words += this;
    }
    return false;
}

void sb_cpu_lacking(const char *all, const char *others, struct sb_text *text)
{
    const char *word = all;
    for (word += strspn(word, " "); *word; word += strspn(word, " ")) {
        const size_t length = strcspn(word, " ");
        if (!holds(others, word, length)) {
            if (text->length)
                sb_text_add(text, " ");
            sb_text_add_n(text, word, length);
        }
        word += length;
    }
}
