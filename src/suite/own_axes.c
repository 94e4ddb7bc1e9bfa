// `axes:` of a suite: axes of its own.
#include <string.h>

#include "suite/draft.h"
#include "base/words.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

// The text under `key`, or `init` where there is none; NULL where it is no text.
static const char *text_of(const struct sb_yaml *map, const char *key, const char *init,
                           struct sb_error *err)
{
    const struct sb_yaml *node = sb_yaml_get(map, key);
    if (!node)
        return init;
    return sb_yaml_expect(node, SB_YAML_TEXT, key, err) ? node->text : NULL;
}

static bool read_value(const struct sb_yaml *node, struct sb_value *value,
                       struct sb_error *err)
{
    static const char *const keys[] = {"name", "text", "help"};
    *value = (struct sb_value){.sets = ""};
    if (node->kind == SB_YAML_TEXT) {
        value->name = value->text = node->text;
        value->help = "";
        return true;
    }
    if (!sb_yaml_expect(node, SB_YAML_MAP, "a value that is not one word", err) ||
        !sb_yaml_keys(node, keys, COUNT(keys), err))
        return false;
    if (!sb_yaml_get(node, "name"))
        return sb_yaml_fail(node, err, "a value needs a name");
    return (value->name = text_of(node, "name", NULL, err)) &&
           (value->text = text_of(node, "text", value->name, err)) &&
           (value->help = text_of(node, "help", "", err));
}

static bool read_choice(const struct sb_yaml *map, struct sb_arena *arena,
                        struct sb_axis *axis, struct sb_error *err)
{
    static const char *const numbers_only[] = {"min", "max", "whole"};
    for (int i = 0; i < COUNT(numbers_only); i++) {
        const struct sb_yaml *node = sb_yaml_get(map, numbers_only[i]);
        if (node)
            return sb_yaml_fail(node, err, "axis \"%s\" has values, so it takes no %s",
                                axis->name, numbers_only[i]);
    }
    const struct sb_yaml *list = sb_yaml_get(map, "values");
    if (!sb_yaml_expect(list, SB_YAML_LIST, "values", err))
        return false;
    struct sb_value *values = sb_arena_alloc(arena, (size_t)list->count * sizeof *values);
    for (int i = 0; i < list->count; i++)
        if (!read_value(&list->child[i], &values[i], err))
            return false;
    axis->values = values;
    axis->value_count = list->count;
    axis->max = list->count - 1;
    const struct sb_yaml *init = sb_yaml_get(map, "init");
    if (!init)
        return true;
    if (!sb_yaml_expect(init, SB_YAML_TEXT, "init", err))
        return false;
    axis->init = sb_axis_value_expect(axis, init->text, err);
    return axis->init >= 0 || sb_yaml_prefix(init, err);
}

static bool read_number(const struct sb_yaml *map, struct sb_axis *axis,
                        struct sb_error *err)
{
    static const char *const keys[] = {"min", "max", "init"};
    double *const fields[] = {&axis->min, &axis->max, &axis->init};
    for (int i = 0; i < COUNT(keys); i++) {
        const struct sb_yaml *node = sb_yaml_get(map, keys[i]);
        if (!node)
            return sb_yaml_fail(
                map, err,
                "axis \"%s\" has no %s; an axis has values, or min, max and "
                "init",
                axis->name, keys[i]);
        if (!sb_yaml_expect(node, SB_YAML_TEXT, keys[i], err))
            return false;
        if (!sb_parse_number(node->text, fields[i]))
            return sb_yaml_fail(node, err, "%s: \"%s\" is not a number", keys[i],
                                node->text);
    }
    const char *whole = text_of(map, "whole", "false", err);
    if (!whole)
        return false;
    if (strcmp(whole, "true") == 0)
        axis->flags |= SB_WHOLE;
    else if (strcmp(whole, "false") != 0)
        return sb_yaml_fail(sb_yaml_get(map, "whole"), err,
                            "whole: unknown word \"%s\"; valid: true false", whole);
    return true;
}

static bool read_kind(const struct sb_yaml *map, struct sb_axis *axis,
                      struct sb_error *err)
{
    const char *kind = text_of(map, "kind", NULL, err);
    for (int i = 0; kind && i < SB_AXIS_KIND_COUNT; i++)
        if (strcmp(kind, sb_axis_kind_names[i]) == 0) {
            axis->kind = (enum sb_axis_kind)i;
            return true;
        }
    if (!kind)
        return false;
    sb_fail_unknown(err, axis->name, "kind", kind, sb_axis_kind_names,
                    SB_AXIS_KIND_COUNT);
    return sb_yaml_prefix(sb_yaml_get(map, "kind"), err);
}

static bool read_axis(const struct sb_yaml *map, struct sb_suite *suite,
                      struct sb_error *err)
{
    static const char *const keys[] = {"name", "kind",  "define", "help",
                                       "when", "needs", "init",   "values",
                                       "min",  "max",   "whole"};
    // Without a define nothing drawn would depend on the axis, yet rows would name it.
    static const char *const wanted[] = {"name", "kind", "define"};
    if (!sb_yaml_expect(map, SB_YAML_MAP, "an axis", err) ||
        !sb_yaml_keys(map, keys, COUNT(keys), err))
        return false;
    for (int i = 0; i < COUNT(wanted); i++) {
        const struct sb_yaml *node = sb_yaml_get(map, wanted[i]);
        if (!node || (node->kind == SB_YAML_TEXT && !*node->text))
            return sb_yaml_fail(node ? node : map, err, "an axis needs a %s", wanted[i]);
    }
    struct sb_axis axis = {0};
    if (!(axis.name = text_of(map, "name", NULL, err)) ||
        !(axis.define = text_of(map, "define", NULL, err)) ||
        !(axis.when = text_of(map, "when", "", err)) ||
        !(axis.needs = text_of(map, "needs", "", err)) ||
        !(axis.help = text_of(map, "help", "", err)) || !read_kind(map, &axis, err))
        return false;
    if (!(sb_yaml_get(map, "values") ? read_choice(map, &suite->arena, &axis, err)
                                     : read_number(map, &axis, err)))
        return false;
    return sb_axes_add(&suite->axes, &axis, err) || sb_yaml_prefix(map, err);
}

bool sb_draft_axes(const struct sb_yaml *root, struct sb_suite *suite,
                   struct sb_error *err)
{
    const struct sb_yaml *list = sb_yaml_get(root, "axes");
    if (!list)
        return true;
    if (!sb_yaml_expect(list, SB_YAML_LIST, "axes", err))
        return false;
    for (int i = 0; i < list->count; i++)
        if (!read_axis(&list->child[i], suite, err))
            return false;
    return true;
}
