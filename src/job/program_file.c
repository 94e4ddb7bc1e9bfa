#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "job/program_file.h"

// The header: numbers are little-endian.
static const char magic[8] = {'S', 'B', 'P', 'R', 'O', 'G', '\r', '\n'};
enum { VERSION = 1 };
enum {
    AT_VERSION = 8,   // 4 bytes
    AT_FORMAT = 12,   // 4
    AT_DRIVER = 16,   // 8
    AT_SOURCES = 24,  // 8
    AT_SIZE = 32,     // 8, of the binary
    AT_CHECKSUM = 40, // 8, of all that stands before it and of the binary
};

static void put(unsigned char *byte, uint64_t value, int count)
{
    for (int i = 0; i < count; i++)
        byte[i] = (unsigned char)(value >> (8 * i));
}

static uint64_t get(const unsigned char *byte, int count)
{
    uint64_t value = 0;
    for (int i = 0; i < count; i++)
        value |= (uint64_t)byte[i] << (8 * i);
    return value;
}

// An absent text is not an empty one, and neighbours cannot trade characters.
static uint64_t add_text(uint64_t hash, const char *text)
{
    const unsigned char there = text != NULL;
    hash = sb_hash(hash, &there, 1);
    return text ? sb_hash(hash, text, strlen(text) + 1) : hash;
}

static uint64_t add_texts(uint64_t hash, const char *const *text, int count)
{
    for (int i = 0; i < count; i++)
        hash = add_text(hash, text[i]);
    return add_text(hash, NULL); // the end
}

uint64_t sb_program_key_driver(const struct sb_caps *caps)
{
    const char *const texts[] = {caps->vendor,  caps->renderer,
                                 caps->version, caps->glsl_version,
                                 caps->context, caps->gles ? "gles" : "gl"};
    return add_texts(SB_HASH_START, texts, sizeof texts / sizeof *texts);
}

uint64_t sb_program_key_sources(const struct sb_program_parts *parts)
{
    const struct sb_program *source = parts->source;
    const char *const stages[] = {source->vertex, source->geometry, source->fragment};
    uint64_t hash = add_texts(SB_HASH_START, stages, sizeof stages / sizeof *stages);
    hash = add_texts(hash, parts->varying, parts->varying_count);
    return add_texts(hash, parts->attribute, parts->attribute_count);
}

void sb_program_file_name(const struct sb_program_key *key,
                          char name[static SB_PROGRAM_FILE_NAME])
{
    snprintf(name, SB_PROGRAM_FILE_NAME, "%016" PRIx64 "-%016" PRIx64 "%s", key->driver,
             key->sources, SB_PROGRAM_FILE_SUFFIX);
}

static uint64_t checksum(const unsigned char *data, size_t size)
{
    const uint64_t head = sb_hash(SB_HASH_START, data, AT_CHECKSUM);
    return sb_hash(head, data + SB_PROGRAM_FILE_HEADER, size - SB_PROGRAM_FILE_HEADER);
}

unsigned char *sb_program_file_encode(const struct sb_program_file *file, size_t *size)
{
    if (file->size == 0 || file->size > SB_PROGRAM_FILE_LIMIT - SB_PROGRAM_FILE_HEADER)
        return NULL;
    *size = SB_PROGRAM_FILE_HEADER + file->size;
    unsigned char *data = sb_alloc(*size);
    memcpy(data, magic, sizeof magic);
    put(data + AT_VERSION, VERSION, 4);
    put(data + AT_FORMAT, file->format, 4);
    put(data + AT_DRIVER, file->key.driver, 8);
    put(data + AT_SOURCES, file->key.sources, 8);
    put(data + AT_SIZE, file->size, 8);
    memcpy(data + SB_PROGRAM_FILE_HEADER, file->binary, file->size);
    put(data + AT_CHECKSUM, checksum(data, *size), 8);
    return data;
}

// That the bytes are a whole file of this version, whatever of.
static bool check_whole(const unsigned char *data, size_t size, const char *path,
                        struct sb_error *err)
{
    if (size < SB_PROGRAM_FILE_HEADER)
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: %zu bytes; a program's file has more than %d", path, size,
                       SB_PROGRAM_FILE_HEADER);
    if (memcmp(data, magic, sizeof magic) != 0)
        return sb_fail(err, SB_BAD_INPUT, "%s: is no file of a program", path);
    const uint64_t version = get(data + AT_VERSION, 4);
    if (version != VERSION)
        return sb_fail(err, SB_BAD_INPUT, "%s: version %" PRIu64 "; %d is read", path,
                       version, VERSION);
    const uint64_t stated = get(data + AT_SIZE, 8);
    const size_t there = size - SB_PROGRAM_FILE_HEADER;
    if (stated != there || there == 0 || size > SB_PROGRAM_FILE_LIMIT)
        return sb_fail(err, SB_BAD_INPUT, "%s: holds %zu bytes of a binary of %" PRIu64,
                       path, there, stated);
    if (get(data + AT_CHECKSUM, 8) != checksum(data, size))
        return sb_fail(err, SB_BAD_INPUT, "%s: is damaged: its checksum does not fit",
                       path);
    return true;
}

bool sb_program_file_decode(const void *data, size_t size, const char *path,
                            const struct sb_program_key *key,
                            struct sb_program_file *file, struct sb_error *err)
{
    const unsigned char *byte = data;
    if (!check_whole(byte, size, path, err))
        return false;
    if (get(byte + AT_DRIVER, 8) != key->driver)
        return sb_fail(err, SB_BAD_INPUT, "%s: was made by another driver", path);
    if (get(byte + AT_SOURCES, 8) != key->sources)
        return sb_fail(err, SB_BAD_INPUT, "%s: is of another program", path);
    *file = (struct sb_program_file){
        .key = *key,
        .format = (uint32_t)get(byte + AT_FORMAT, 4),
        .binary = byte + SB_PROGRAM_FILE_HEADER,
        .size = size - SB_PROGRAM_FILE_HEADER,
    };
    return true;
}
