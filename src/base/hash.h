// FNV-1a, 64 bits: names for sources, scenes and binaries. Not for untrusted input.
#pragma once

#include <stddef.h>
#include <stdint.h>

#define SB_HASH_START UINT64_C(14695981039346656037)

static inline uint64_t sb_hash(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *byte = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ byte[i]) * UINT64_C(1099511628211);
    return hash;
}
