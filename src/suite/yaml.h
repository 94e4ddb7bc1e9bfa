// One YAML document as a tree of texts, lists and maps that know where they stand.
//
// What suites have no use for is refused here, with file:line:column: a second document,
// an empty file, a key twice or a key that is no text, an alias inside what it stands for,
// NUL bytes, more than 8 levels, 20 000 nodes (aliases counted where they are used) or 1 MB.
// No `err` is NULL here.
#pragma once

#include "base/error.h"
#include "base/mem.h"

enum sb_yaml_kind { SB_YAML_TEXT, SB_YAML_LIST, SB_YAML_MAP };

struct sb_yaml {
    enum sb_yaml_kind kind;
    const char *file;
    int line, column;            // from 1
    const char *text;            // of a text; "" for a key without a value
    const struct sb_yaml *child; // of a list or a map, in the order written
    const struct sb_yaml *key;   // of a map: key[i] is the text before child[i]
    int count;
};

// The root, which is a map; all of it lives in `arena`. NULL on failure.
const struct sb_yaml *sb_yaml_load(struct sb_arena *arena, const char *path,
                                   struct sb_error *err);

// The map's child under `key`, or NULL.
const struct sb_yaml *sb_yaml_get(const struct sb_yaml *map, const char *key);

// Fails, naming the valid ones, if `map` has a key that is not among them.
bool sb_yaml_keys(const struct sb_yaml *map, const char *const *valid, int count,
                  struct sb_error *err);

// Fails unless `node`, called `what` in the message, is of that kind.
bool sb_yaml_expect(const struct sb_yaml *node, enum sb_yaml_kind kind, const char *what,
                    struct sb_error *err);

// Both return false: a failure at `node`; its place put before the failure in *err.
bool sb_yaml_fail(const struct sb_yaml *node, struct sb_error *err, const char *format,
                  ...) __attribute__((format(printf, 3, 4)));
bool sb_yaml_prefix(const struct sb_yaml *node, struct sb_error *err);
