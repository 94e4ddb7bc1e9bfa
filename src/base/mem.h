// Memory with one owner: an arena that is freed at once, and a growing array.
//
// Allocation never returns NULL: a benchmark that cannot have a few megabytes has nothing
// left to measure, so the process ends with one line and exit code 3.
#pragma once

#include <stddef.h>

void *sb_alloc(size_t size);              // zeroed; free()
void *sb_realloc(void *old, size_t size); // not zeroed
char *sb_strdup(const char *text);

// Memory that is freed together. Zero-initialise, use, sb_arena_free().
struct sb_arena {
    struct sb_arena_block *last;
};
void *sb_arena_alloc(struct sb_arena *arena, size_t size); // zeroed, aligned to 16
char *sb_arena_strdup(struct sb_arena *arena, const char *text);
char *sb_arena_printf(struct sb_arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void sb_arena_free(struct sb_arena *arena);

// Makes room for one more element of `array` (count elements used, *capacity allocated).
// Usage: list = sb_grow(list, count, &capacity, sizeof *list);
void *sb_grow(void *array, int count, int *capacity, size_t element);
