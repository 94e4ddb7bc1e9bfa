#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "wire/fields.h"

json_t *sb_text_json(const char *text)
{
    json_t *json = json_string(text);
    if (json)
        return json;
    char *plain = sb_strdup(text);
    for (char *p = plain; *p; p++)
        if ((unsigned char)*p >= 128)
            *p = '?';
    json = json_string(plain);
    free(plain);
    return json;
}

static json_t *real_json(double value)
{
    if (isnan(value))
        return json_string("nan");
    if (isinf(value))
        return json_string(value > 0 ? "inf" : "-inf");
    return json_real(value);
}

static bool real_of(const json_t *json, double *value)
{
    const char *word = json_string_value(json);
    *value = word ? strcmp(word, "inf") == 0    ? INFINITY
                    : strcmp(word, "-inf") == 0 ? -INFINITY
                                                : NAN
                  : json_number_value(json);
    return json_is_number(json) || (word && (!isnan(*value) || strcmp(word, "nan") == 0));
}

static json_t *pack_field(const struct sb_field *field, const void *at)
{
    char digits[32];
    switch (field->type) {
    case SB_FIELD_INT:
        return json_integer(*(const int *)at);
    case SB_FIELD_UNSIGNED:
        return json_integer(*(const unsigned *)at);
    case SB_FIELD_INT64:
        return json_integer(*(const int64_t *)at);
    case SB_FIELD_UINT64:
        snprintf(digits, sizeof digits, "%" PRIu64, *(const uint64_t *)at);
        return json_string(digits);
    case SB_FIELD_BOOL:
        return json_boolean(*(const bool *)at);
    case SB_FIELD_FLOAT:
        return real_json(*(const float *)at);
    case SB_FIELD_DOUBLE:
        return real_json(*(const double *)at);
    case SB_FIELD_CHARS:
        return sb_text_json(at);
    case SB_FIELD_STRING:
        return sb_text_json(*(const char *const *)at);
    }
    return json_null();
}

static bool is_uint64(const char *word, uint64_t *value)
{
    char *end;
    if (!word || word[0] < '0' || word[0] > '9')
        return false;
    *value = strtoull(word, &end, 10);
    return *end == '\0';
}

static bool unpack_whole(const struct sb_field *field, const json_t *json, void *at)
{
    const json_int_t value = json_integer_value(json);
    if (!json_is_integer(json))
        return false;
    if (field->type == SB_FIELD_INT)
        *(int *)at = (int)value;
    else if (field->type == SB_FIELD_UNSIGNED)
        *(unsigned *)at = (unsigned)value;
    else
        *(int64_t *)at = value;
    return field->type == SB_FIELD_INT        ? value == *(int *)at
           : field->type == SB_FIELD_UNSIGNED ? value == *(unsigned *)at
                                              : true;
}

static bool unpack_field(const struct sb_field *field, const json_t *json, void *at,
                         struct sb_arena *arena)
{
    const char *word = json_string_value(json);
    double value;
    switch (field->type) {
    case SB_FIELD_INT:
    case SB_FIELD_UNSIGNED:
    case SB_FIELD_INT64:
        return unpack_whole(field, json, at);
    case SB_FIELD_UINT64:
        return is_uint64(word, at);
    case SB_FIELD_BOOL:
        *(bool *)at = json_is_true(json);
        return json_is_boolean(json);
    case SB_FIELD_FLOAT:
    case SB_FIELD_DOUBLE:
        if (!real_of(json, &value))
            return false;
        if (field->type == SB_FIELD_FLOAT)
            *(float *)at = (float)value;
        else
            *(double *)at = value;
        return true;
    case SB_FIELD_CHARS:
        if (word)
            snprintf(at, field->size, "%s", word);
        return word;
    case SB_FIELD_STRING:
        if (word && arena)
            *(const char **)at = sb_arena_strdup(arena, word);
        return word && arena;
    }
    return false;
}

json_t *sb_fields_pack(const struct sb_field *field, int count, const void *object)
{
    json_t *json = json_object();
    for (int i = 0; i < count; i++)
        json_object_set_new(
            json, field[i].name,
            pack_field(&field[i], (const char *)object + field[i].offset));
    return json;
}

bool sb_fields_unpack(const struct sb_field *field, int count, const json_t *json,
                      void *object, struct sb_arena *arena, struct sb_error *err)
{
    for (int i = 0; i < count; i++)
        if (!unpack_field(&field[i], json_object_get(json, field[i].name),
                          (char *)object + field[i].offset, arena))
            return sb_fail(
                err, SB_WORKER_GARBAGE,
                "wrote a message in which \"%s\" is missing or of another type",
                field[i].name);
    return true;
}

json_t *sb_fields_pack_all(const struct sb_field *field, int count, const void *array,
                           int length, size_t element)
{
    json_t *json = json_array();
    for (int i = 0; i < length; i++)
        json_array_append_new(
            json,
            sb_fields_pack(field, count, (const char *)array + (size_t)i * element));
    return json;
}

bool sb_fields_unpack_all(const struct sb_field *field, int count, const json_t *json,
                          void *array, int limit, size_t element, int *length,
                          struct sb_arena *arena, struct sb_error *err)
{
    const size_t size = json_array_size(json); // 0 where it is none
    if (!json_is_array(json) || size > (size_t)limit)
        return sb_fail(err, SB_WORKER_GARBAGE,
                       "wrote a message with a list that is none, or has over %d items",
                       limit);
    *length = (int)size;
    for (size_t i = 0; i < size; i++)
        if (!sb_fields_unpack(field, count, json_array_get(json, i),
                              (char *)array + i * element, arena, err))
            return false;
    return true;
}
