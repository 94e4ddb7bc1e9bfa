// Plain structs as JSON objects and back, by a table of their fields: the one list of what a
// struct sends.
#pragma once

#include <jansson.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/mem.h"

struct sb_field {
    const char *name;
    enum sb_field_type {
        SB_FIELD_INT,
        SB_FIELD_UNSIGNED,
        SB_FIELD_INT64,
        SB_FIELD_UINT64, // a string of digits: JSON's integers end at 2^63
        SB_FIELD_BOOL,
        SB_FIELD_FLOAT, // and double: "nan", "inf", "-inf" where they are not finite
        SB_FIELD_DOUBLE,
        SB_FIELD_CHARS,  // an array of char
        SB_FIELD_STRING, // const char *, never NULL
    } type;
    size_t offset, size;
};

// A row of such a table; the type is the member's own. Enums are int or unsigned.
#define SB_FIELD(type, member)                                                           \
    {                                                                                    \
#member,                                                                         \
            _Generic(((type *)0)->member,                                                \
                int: SB_FIELD_INT,                                                       \
                unsigned: SB_FIELD_UNSIGNED,                                             \
                int64_t: SB_FIELD_INT64,                                                 \
                uint64_t: SB_FIELD_UINT64,                                               \
                bool: SB_FIELD_BOOL,                                                     \
                float: SB_FIELD_FLOAT,                                                   \
                double: SB_FIELD_DOUBLE,                                                 \
                char *: SB_FIELD_CHARS,                                                  \
                const char *: SB_FIELD_STRING),                                          \
            offsetof(type, member), sizeof((type *)0)->member       \
    }

// Bytes that are no UTF-8 become '?'. New references.
json_t *sb_text_json(const char *text);
json_t *sb_fields_pack(const struct sb_field *field, int count, const void *object);

// Every field must be there, and of its type: SB_WORKER_GARBAGE names the first that is not.
// Strings live in `arena`, which may be NULL where there are none.
bool sb_fields_unpack(const struct sb_field *field, int count, const json_t *json,
                      void *object, struct sb_arena *arena, struct sb_error *err);

// Arrays of such objects. Unpacking: `limit` is the room in `array`.
json_t *sb_fields_pack_all(const struct sb_field *field, int count, const void *array,
                           int length, size_t element);
bool sb_fields_unpack_all(const struct sb_field *field, int count, const json_t *json,
                          void *array, int limit, size_t element, int *length,
                          struct sb_arena *arena, struct sb_error *err);
