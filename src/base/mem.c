#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/mem.h"

struct sb_arena_block {
    struct sb_arena_block *previous;
    size_t used, size;
    max_align_t data[];
};

static _Noreturn void out_of_memory(size_t size)
{
    fprintf(stderr, "shadebench: out of memory (%zu bytes wanted)\n", size);
    exit(sb_status_rows[SB_INTERNAL].exit_code);
}

void *sb_alloc(size_t size)
{
    void *p = calloc(1, size ? size : 1);
    if (!p)
        out_of_memory(size);
    return p;
}

void *sb_realloc(void *old, size_t size)
{
    void *p = realloc(old, size ? size : 1);
    if (!p)
        out_of_memory(size);
    return p;
}

char *sb_strdup(const char *text)
{
    const size_t size = strlen(text) + 1;
    return memcpy(sb_alloc(size), text, size);
}

void *sb_arena_alloc(struct sb_arena *arena, size_t size)
{
    size = (size + 15) & ~(size_t)15;
    struct sb_arena_block *block = arena->last;
    if (!block || block->size - block->used < size) {
        const size_t room = size > 16384 ? size : 16384;
        block = sb_alloc(sizeof *block + room);
        block->size = room;
        block->previous = arena->last;
        arena->last = block;
    }
    void *p = (char *)block->data + block->used;
    block->used += size;
    return p;
}

char *sb_arena_strdup(struct sb_arena *arena, const char *text)
{
    const size_t size = strlen(text) + 1;
    return memcpy(sb_arena_alloc(arena, size), text, size);
}

char *sb_arena_printf(struct sb_arena *arena, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = sb_arena_alloc(arena, (size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

void sb_arena_free(struct sb_arena *arena)
{
    while (arena->last) {
        struct sb_arena_block *block = arena->last;
        arena->last = block->previous;
        free(block);
    }
}

void *sb_grow(void *array, int count, int *capacity, size_t element)
{
    if (count < *capacity)
        return array;
    *capacity = *capacity ? *capacity * 2 : 16;
    return sb_realloc(array, (size_t)*capacity * element);
}
