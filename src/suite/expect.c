// `expect:` of a suite: which rows, which column, which bound.
#include <string.h>

#include "suite/draft.h"

// Reads one key of `where`: the scene, or an axis.
static bool read_condition(const struct sb_yaml *key, const struct sb_yaml *node,
                           struct sb_suite *suite, struct sb_expectation *expectation,
                           struct sb_expect_axis *axis, struct sb_error *err)
{
    if (strcmp(key->text, "scene") == 0)
        return sb_draft_texts(node, "scene", &suite->arena, &expectation->scene,
                              &expectation->scene_count, err) &&
               (expectation->scene_count > 0 ||
                sb_yaml_fail(node, err, "scene: an empty list"));
    struct sb_values values = {.count = 0};
    axis->axis = sb_axes_expect(&suite->axes, key->text, err);
    if (axis->axis < 0)
        return sb_yaml_prefix(key, err);
    if (!sb_draft_values(node, &suite->axes, axis->axis, &values, err))
        return false;
    if (values.count == 0)
        return sb_yaml_fail(key, err, "%s: no values", key->text);
    double *copy = sb_arena_alloc(&suite->arena, (size_t)values.count * sizeof *copy);
    memcpy(copy, values.value, (size_t)values.count * sizeof *copy);
    axis->value = copy;
    axis->count = values.count;
    expectation->axis_count++;
    return true;
}

static bool read_where(const struct sb_yaml *where, struct sb_suite *suite,
                       struct sb_expectation *expectation, struct sb_error *err)
{
    if (!sb_yaml_expect(where, SB_YAML_MAP, "where", err))
        return false;
    struct sb_expect_axis *axis =
        sb_arena_alloc(&suite->arena, ((size_t)where->count + 1) * sizeof *axis);
    expectation->axis = axis;
    for (int i = 0; i < where->count; i++)
        if (!read_condition(&where->key[i], &where->child[i], suite, expectation,
                            &axis[expectation->axis_count], err))
            return false;
    return true;
}

static const char *place_of(const struct sb_yaml *node, struct sb_arena *arena)
{
    return sb_arena_printf(arena, "%s:%d:%d", node->file, node->line, node->column);
}

// Appends an expectation for each column of the item.
static bool read_item(const struct sb_yaml *item, struct sb_suite *suite,
                      struct sb_expectation *list, struct sb_error *err)
{
    struct sb_expectation expectation = {0};
    const struct sb_yaml *const where = sb_yaml_get(item, "where");
    const int before = suite->expect_count;
    if (where && !read_where(where, suite, &expectation, err))
        return false;
    for (int i = 0; i < item->count; i++) {
        const struct sb_yaml *const column = &item->key[i], *const bound =
                                                                &item->child[i];
        if (bound == where)
            continue;
        if (!sb_yaml_expect(bound, SB_YAML_TEXT, column->text, err))
            return false;
        expectation.column = column->text;
        expectation.column_at = place_of(column, &suite->arena);
        expectation.bound = bound->text;
        expectation.bound_at = place_of(bound, &suite->arena);
        list[suite->expect_count++] = expectation;
    }
    return suite->expect_count > before ||
           sb_yaml_fail(item, err,
                        "expect: nothing is expected here; wanted: a column of "
                        "summary.csv, like max_err: \"<= 2/255\"");
}

bool sb_draft_expect(const struct sb_yaml *root, struct sb_suite *suite,
                     struct sb_error *err)
{
    const struct sb_yaml *const node = sb_yaml_get(root, "expect");
    int room = 0;
    if (!node)
        return true;
    if (!sb_yaml_expect(node, SB_YAML_LIST, "expect", err))
        return false;
    if (node->count == 0)
        return sb_yaml_fail(node, err, "expect: an empty list");
    for (int i = 0; i < node->count; i++) {
        if (!sb_yaml_expect(&node->child[i], SB_YAML_MAP, "an item of expect", err))
            return false;
        room += node->child[i].count;
    }
    struct sb_expectation *list =
        sb_arena_alloc(&suite->arena, ((size_t)room + 1) * sizeof *list);
    suite->expect = list;
    for (int i = 0; i < node->count; i++)
        if (!read_item(&node->child[i], suite, list, err))
            return false;
    return true;
}
