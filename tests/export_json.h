// Reading the JSON of export/ back.
#pragma once

#include "export_rows.h"

#include <jansson.h>

static inline json_t *written_json(const char *format, const struct sb_export *export)
{
    json_error_t cause;
    char *text = written(format, export);
    json_t *json = json_loads(text, JSON_REJECT_DUPLICATES, &cause);
    if (!json)
        fail_msg("%s in\n%s", cause.text, text);
    free(text);
    return json;
}

// Members; the path is keys and, in lists, places with dots between them.
static inline const json_t *member(const json_t *json, const char *path)
{
    char key[128];
    for (; json && *path; path += *path == '.') {
        const size_t length = strcspn(path, ".");
        assert_true(length < sizeof key);
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        json = json_is_array(json) ? json_array_get(json, (size_t)atoi(key))
                                   : json_object_get(json, key);
        path += length;
    }
    return json;
}

static inline void check_number(const json_t *json, const char *path, double wanted)
{
    const json_t *value = member(json, path);
    if (!json_is_number(value))
        fail_msg("no number %s", path);
    check_close(json_number_value(value), wanted, 1e-12 * fabs(wanted));
}

static inline void check_string(const json_t *json, const char *path, const char *wanted)
{
    const json_t *value = member(json, path);
    if (!json_is_string(value))
        fail_msg("no text %s", path);
    assert_string_equal(json_string_value(value), wanted);
}

static inline void check_absent(const json_t *json, const char *path)
{
    if (member(json, path))
        fail_msg("there is a %s", path);
}
