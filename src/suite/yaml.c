#include <stdarg.h>
#include <string.h>
#include <yaml.h>

#include "axis/axis.h"
#include "base/file.h"
#include "base/words.h"
#include "suite/yaml.h"

enum { DEPTH_MAX = 8, NODES_MAX = 20000, BYTES_MAX = 1000000 };

struct walk {
    struct sb_arena *arena;
    const char *file;
    yaml_document_t *document;
    int open[DEPTH_MAX]; // the nodes from the root to here
    int nodes;
};

static bool fail_at(struct sb_error *err, const char *file, yaml_mark_t mark,
                    const char *what)
{
    return sb_fail(err, SB_BAD_INPUT, "%s:%zu:%zu: %s", file, mark.line + 1,
                   mark.column + 1, what);
}

static bool fill(struct walk *walk, int id, int depth, struct sb_yaml *node,
                 struct sb_error *err);

static bool fill_text(struct walk *walk, const yaml_node_t *from, struct sb_yaml *node,
                      struct sb_error *err)
{
    const char *const text = (const char *)from->data.scalar.value;
    if (strlen(text) != from->data.scalar.length)
        return fail_at(err, walk->file, from->start_mark, "a NUL character in a text");
    node->text = sb_arena_strdup(walk->arena, text);
    return true;
}

static bool fill_list(struct walk *walk, const yaml_node_t *from, int depth,
                      struct sb_yaml *node, struct sb_error *err)
{
    const yaml_node_item_t *const item = from->data.sequence.items.start;
    node->count = (int)(from->data.sequence.items.top - item);
    struct sb_yaml *child =
        sb_arena_alloc(walk->arena, (size_t)node->count * sizeof *child);
    node->child = child;
    for (int i = 0; i < node->count; i++)
        if (!fill(walk, item[i], depth + 1, &child[i], err))
            return false;
    return true;
}

static bool fill_map(struct walk *walk, const yaml_node_t *from, int depth,
                     struct sb_yaml *node, struct sb_error *err)
{
    const yaml_node_pair_t *const pair = from->data.mapping.pairs.start;
    const int count = (int)(from->data.mapping.pairs.top - pair);
    struct sb_yaml *child = sb_arena_alloc(walk->arena, (size_t)count * sizeof *child);
    struct sb_yaml *key = sb_arena_alloc(walk->arena, (size_t)count * sizeof *key);
    node->child = child;
    node->key = key;
    for (; node->count < count; node->count++) {
        const int i = node->count;
        if (!fill(walk, pair[i].key, depth + 1, &key[i], err) ||
            !sb_yaml_expect(&key[i], SB_YAML_TEXT, "a key", err))
            return false;
        const struct sb_yaml *const earlier = sb_yaml_get(node, key[i].text);
        if (earlier)
            return sb_yaml_fail(&key[i], err,
                                "key \"%s\" is there already, with a value on "
                                "line %d",
                                key[i].text, earlier->line);
        if (!fill(walk, pair[i].value, depth + 1, &child[i], err))
            return false;
    }
    return true;
}

static bool fill(struct walk *walk, int id, int depth, struct sb_yaml *node,
                 struct sb_error *err)
{
    const yaml_node_t *const from = yaml_document_get_node(walk->document, id);
    *node = (struct sb_yaml){.file = walk->file,
                             .line = (int)from->start_mark.line + 1,
                             .column = (int)from->start_mark.column + 1};
    for (int i = 0; i < depth; i++)
        if (walk->open[i] == id)
            return fail_at(err, walk->file, from->start_mark,
                           "an alias stands inside what it stands for");
    if (depth == DEPTH_MAX)
        return fail_at(err, walk->file, from->start_mark, "more than 8 levels");
    if (++walk->nodes > NODES_MAX)
        return fail_at(err, walk->file, from->start_mark,
                       "more than 20000 values and keys in all");
    walk->open[depth] = id;
    switch (from->type) {
    case YAML_SEQUENCE_NODE:
        node->kind = SB_YAML_LIST;
        return fill_list(walk, from, depth, node, err);
    case YAML_MAPPING_NODE:
        node->kind = SB_YAML_MAP;
        return fill_map(walk, from, depth, node, err);
    default:
        node->kind = SB_YAML_TEXT;
        return fill_text(walk, from, node, err);
    }
}

// libyaml puts no mark on bytes that are no UTF-8, only an offset.
static bool fail_parser(const yaml_parser_t *parser, const char *file,
                        struct sb_error *err)
{
    if (parser->error == YAML_READER_ERROR)
        return sb_fail(err, SB_BAD_INPUT, "%s: byte %zu: %s", file,
                       parser->problem_offset, parser->problem);
    return fail_at(err, file, parser->problem_mark,
                   parser->problem ? parser->problem : "this is no YAML");
}

static bool load_document(yaml_parser_t *parser, struct walk *walk, struct sb_yaml *root,
                          struct sb_error *err)
{
    yaml_document_t document, second;
    if (!yaml_parser_load(parser, &document))
        return fail_parser(parser, walk->file, err);
    walk->document = &document;
    const yaml_node_t *const top = yaml_document_get_root_node(&document);
    bool good = top ? fill(walk, 1, 0, root, err)
                    : sb_fail(err, SB_BAD_INPUT,
                              "%s:1:1: empty; a map is wanted: suite: NAME", walk->file);
    yaml_document_delete(&document);
    if (!good)
        return false;
    if (!yaml_parser_load(parser, &second))
        return fail_parser(parser, walk->file, err);
    const yaml_node_t *const more = yaml_document_get_root_node(&second);
    if (more)
        good = fail_at(err, walk->file, more->start_mark,
                       "a second document; one file holds one");
    yaml_document_delete(&second);
    return good;
}

const struct sb_yaml *sb_yaml_load(struct sb_arena *arena, const char *path,
                                   struct sb_error *err)
{
    size_t size;
    const char *const bytes = sb_file_read(arena, path, BYTES_MAX, &size, err);
    if (!bytes)
        return NULL;
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) {
        sb_fail(err, SB_INTERNAL, "%s: libyaml does not start", path);
        return NULL;
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)bytes, size);
    struct sb_yaml *root = sb_arena_alloc(arena, sizeof *root);
    struct walk walk = {.arena = arena, .file = sb_arena_strdup(arena, path)};
    const bool good = load_document(&parser, &walk, root, err) &&
                      sb_yaml_expect(root, SB_YAML_MAP, "the file", err);
    yaml_parser_delete(&parser);
    return good ? root : NULL;
}

const struct sb_yaml *sb_yaml_get(const struct sb_yaml *map, const char *key)
{
    for (int i = 0; i < map->count; i++)
        if (strcmp(map->key[i].text, key) == 0)
            return &map->child[i];
    return NULL;
}

bool sb_yaml_keys(const struct sb_yaml *map, const char *const *valid, int count,
                  struct sb_error *err)
{
    for (int i = 0; i < map->count; i++) {
        int k = 0;
        while (k < count && strcmp(map->key[i].text, valid[k]) != 0)
            k++;
        if (k == count) {
            sb_fail_unknown(err, "", "key", map->key[i].text, valid, count);
            return sb_yaml_prefix(&map->key[i], err);
        }
    }
    return true;
}

bool sb_yaml_expect(const struct sb_yaml *node, enum sb_yaml_kind kind, const char *what,
                    struct sb_error *err)
{
    static const char *const names[] = {[SB_YAML_TEXT] = "one word",
                                        [SB_YAML_LIST] = "a list",
                                        [SB_YAML_MAP] = "a map (key: value)"};
    return node->kind == kind || sb_yaml_fail(node, err, "%s must be %s, not %s", what,
                                              names[kind], names[node->kind]);
}

bool sb_yaml_fail(const struct sb_yaml *node, struct sb_error *err, const char *format,
                  ...)
{
    struct sb_text text = {0};
    va_list args;
    va_start(args, format);
    sb_text_vprintf(&text, format, args);
    va_end(args);
    sb_fail(err, SB_BAD_INPUT, "%s:%d:%d: %s", node->file, node->line, node->column,
            sb_text_get(&text));
    sb_text_free(&text);
    return false;
}

bool sb_yaml_prefix(const struct sb_yaml *node, struct sb_error *err)
{
    return sb_fail(err, err->status, "%s:%d:%d: %s", node->file, node->line, node->column,
                   err->text);
}
