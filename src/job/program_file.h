// The file of one program in a program cache: the binary that a driver gave for it, and what it
// was made of and by. Pure bytes, no GL; docs/formats.md has the layout.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "job/job.h"

enum { SB_PROGRAM_FILE_HEADER = 48 };             // bytes before the binary
#define SB_PROGRAM_FILE_LIMIT  ((size_t)64 << 20) // bytes of a whole file, at most
#define SB_PROGRAM_FILE_SUFFIX ".program"

// What a binary is good for: one driver, and one program.
struct sb_program_key {
    uint64_t driver, sources;
};

// What a program is made of, besides the driver.
struct sb_program_parts {
    const struct sb_program *source; // its role does not matter
    const char *const *varying;      // captured by transform feedback, in this order
    const char *const *attribute;    // at locations 0, 1, …
    int varying_count, attribute_count;
};

// Hash of what the driver says of itself: vendor, renderer, version, GLSL version, API and kind
// of context.
uint64_t sb_program_key_driver(const struct sb_caps *caps);
uint64_t sb_program_key_sources(const struct sb_program_parts *parts);

// Name of the key's file in its folder, with SB_PROGRAM_FILE_SUFFIX.
enum { SB_PROGRAM_FILE_NAME = 64 };
void sb_program_file_name(const struct sb_program_key *key,
                          char name[static SB_PROGRAM_FILE_NAME]);

struct sb_program_file {
    struct sb_program_key key;
    uint32_t format; // the driver's own, of glGetProgramBinary
    const void *binary;
    size_t size; // at least 1
};

// The whole file, *size bytes of it; free(). NULL where the binary is empty, or too large for
// SB_PROGRAM_FILE_LIMIT.
unsigned char *sb_program_file_encode(const struct sb_program_file *file, size_t *size);

// False with SB_BAD_INPUT, which begins with `path` and says why, unless the bytes are those of a
// whole, undamaged file of `key`. file->binary points into `data`.
bool sb_program_file_decode(const void *data, size_t size, const char *path,
                            const struct sb_program_key *key,
                            struct sb_program_file *file, struct sb_error *err);
