// The keys of a suite other than `axes:`, and what the command line puts over them.
#include <string.h>

#include "suite/draft.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

static bool check_parts(const struct sb_yaml *parts, struct sb_error *err)
{
    static const char *const keys[] = {"scene", "target", "base",
                                       "sweep", "cross",  "exclude"};
    if (!sb_yaml_expect(parts, SB_YAML_LIST, "parts", err))
        return false;
    if (parts->count == 0)
        return sb_yaml_fail(parts, err, "parts: an empty list");
    for (int i = 0; i < parts->count; i++)
        if (!sb_yaml_expect(&parts->child[i], SB_YAML_MAP, "a part", err) ||
            !sb_yaml_keys(&parts->child[i], keys, COUNT(keys), err))
            return false;
    return true;
}

bool sb_draft_keys(const struct sb_yaml *root, bool preset, struct sb_error *err)
{
    static const char *const keys[] = {"suite",   "about", "scene",   "target", "base",
                                       "exclude", "axes",  "measure", "preset", "sweep",
                                       "cross",   "parts", "expect"};
    const int count = COUNT(keys) - (preset ? 5 : 0);
    if (!sb_yaml_keys(root, keys, count, err))
        return false;
    const struct sb_yaml *name = sb_yaml_get(root, "suite");
    if (!name)
        return sb_yaml_fail(root, err, "no name; wanted: suite: NAME");
    if (!sb_yaml_expect(name, SB_YAML_TEXT, "suite", err))
        return false;
    if (!sb_suite_name_valid(name->text))
        return sb_yaml_fail(name, err,
                            "suite: \"%s\" is no name; valid: letters, digits, - and _",
                            name->text);
    const struct sb_yaml *parts = preset ? NULL : sb_yaml_get(root, "parts");
    return !parts || check_parts(parts, err);
}

bool sb_suite_name_valid(const char *name)
{
    static const char valid[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return *name && strspn(name, valid) == strlen(name);
}

bool sb_draft_texts(const struct sb_yaml *node, const char *what, struct sb_arena *arena,
                    const char *const **list, int *count, struct sb_error *err)
{
    const struct sb_yaml *item = node->kind == SB_YAML_LIST ? node->child : node;
    const int more = node->kind == SB_YAML_LIST ? node->count : 1;
    const char **texts = sb_arena_alloc(arena, (size_t)(*count + more) * sizeof *texts);
    for (int i = 0; i < *count; i++)
        texts[i] = (*list)[i];
    for (int i = 0; i < more; i++) {
        if (!sb_yaml_expect(&item[i], SB_YAML_TEXT, what, err))
            return false;
        if (!*item[i].text)
            return sb_yaml_fail(&item[i], err, "%s: an empty word", what);
        texts[*count + i] = item[i].text;
    }
    *list = texts;
    *count += more;
    return true;
}

static bool read_scene(const struct sb_yaml *node, struct sb_suite *suite,
                       struct sb_draft *draft, struct sb_error *err)
{
    draft->scene_count = 0; // a suite's scenes stand in place of its preset's
    if (!sb_draft_texts(node, "scene", &suite->arena, &draft->scene, &draft->scene_count,
                        err))
        return false;
    return draft->scene_count > 0 || sb_yaml_fail(node, err, "scene: an empty list");
}

static bool read_exclude(const struct sb_yaml *node, struct sb_suite *suite,
                         struct sb_draft *draft, struct sb_error *err)
{
    const int before = draft->exclude_count;
    if (!sb_draft_texts(node, "exclude", &suite->arena, &draft->exclude,
                        &draft->exclude_count, err))
        return false;
    for (int i = before; i < draft->exclude_count; i++)
        if (!sb_condition_check(&suite->axes, draft->exclude[i], err))
            return sb_yaml_prefix(
                node->kind == SB_YAML_LIST ? &node->child[i - before] : node, err);
    return true;
}

// "256x256 rgba16f" stands for three axes of `base`; the format may be left out.
static bool read_target(const struct sb_yaml *node, struct sb_suite *suite,
                        struct sb_draft *draft, struct sb_error *err)
{
    static const char *const axes[] = {"width", "height", "target"};
    if (!sb_yaml_expect(node, SB_YAML_TEXT, "target", err))
        return false;
    char *const width = sb_arena_strdup(&suite->arena, node->text);
    char *rest = strchr(width, 'x');
    if (rest)
        *rest++ = '\0';
    const char *words[3] = {width, NULL, NULL};
    words[1] = rest ? strtok_r(rest, " ", &rest) : NULL;
    words[2] = words[1] ? strtok_r(NULL, " ", &rest) : NULL;
    if (!words[1] || (words[2] && strtok_r(NULL, " ", &rest)))
        return sb_yaml_fail(
            node, err,
            "target: \"%s\" is not of the form WIDTHxHEIGHT or WIDTHxHEIGHT "
            "FORMAT, like 256x256 rgba16f",
            node->text);
    for (int i = 0; i < 3 && words[i]; i++)
        if (!sb_variant_set(&suite->axes, &draft->base,
                            sb_axes_find(&suite->axes, axes[i]), words[i], err))
            return sb_yaml_prefix(node, err);
    return true;
}

static bool read_base(const struct sb_yaml *map, struct sb_suite *suite,
                      struct sb_draft *draft, struct sb_error *err)
{
    if (!sb_yaml_expect(map, SB_YAML_MAP, "base", err))
        return false;
    for (int i = 0; i < map->count; i++) {
        const int axis = sb_axes_expect(&suite->axes, map->key[i].text, err);
        if (axis < 0)
            return sb_yaml_prefix(&map->key[i], err);
        if (!sb_yaml_expect(&map->child[i], SB_YAML_TEXT, "the value of an axis in base",
                            err))
            return false;
        if (!sb_variant_set(&suite->axes, &draft->base, axis, map->child[i].text, err))
            return sb_yaml_prefix(&map->child[i], err);
    }
    return true;
}

static bool has_axis(const struct sb_dimensions *dimensions, int axis)
{
    for (int i = 0; i < dimensions->count; i++)
        if (dimensions->row[i].axis == axis)
            return true;
    return false;
}

// Adds one axis to draft->sweep or draft->cross; it can stand only once in the two.
static bool add_dimension(struct sb_suite *suite, const struct sb_draft *draft,
                          struct sb_dimensions *to, int axis,
                          const struct sb_values *values, struct sb_error *err)
{
    const char *const name = suite->axes.row[axis].name;
    if (has_axis(&draft->sweep, axis) || has_axis(&draft->cross, axis))
        return sb_fail(err, SB_BAD_INPUT,
                       "%s: is there already; an axis stands once, in "
                       "sweep or in cross",
                       name);
    if (values->count == 0)
        return sb_fail(err, SB_BAD_INPUT, "%s: no values", name);
    double *copy = sb_arena_alloc(&suite->arena, (size_t)values->count * sizeof *copy);
    memcpy(copy, values->value, (size_t)values->count * sizeof *copy);
    to->row[to->count++] =
        (struct sb_dimension){.axis = axis, .value = copy, .count = values->count};
    return true;
}

bool sb_draft_values(const struct sb_yaml *node, const struct sb_axes *axes, int axis,
                     struct sb_values *values, struct sb_error *err)
{
    const bool list = node->kind == SB_YAML_LIST;
    const struct sb_yaml *const item = list ? node->child : node;
    for (int k = 0; k < (list ? node->count : 1); k++) {
        if (!sb_yaml_expect(&item[k], SB_YAML_TEXT, "a value", err))
            return false;
        if (!sb_values_add(axes, axis, item[k].text, values, err))
            return sb_yaml_prefix(&item[k], err);
    }
    return true;
}

static bool read_dimensions(const struct sb_yaml *map, const char *what,
                            struct sb_suite *suite, struct sb_draft *draft,
                            struct sb_dimensions *to, struct sb_error *err)
{
    if (!sb_yaml_expect(map, SB_YAML_MAP, what, err))
        return false;
    for (int i = 0; i < map->count; i++) {
        const int axis = sb_axes_expect(&suite->axes, map->key[i].text, err);
        if (axis < 0)
            return sb_yaml_prefix(&map->key[i], err);
        struct sb_values values = {.count = 0};
        if (!sb_draft_values(&map->child[i], &suite->axes, axis, &values, err))
            return false;
        if (!add_dimension(suite, draft, to, axis, &values, err))
            return sb_yaml_prefix(&map->key[i], err);
    }
    return true;
}

static bool read_measure(const struct sb_yaml *map, struct sb_suite *suite,
                         struct sb_error *err)
{
    if (!sb_yaml_expect(map, SB_YAML_MAP, "measure", err))
        return false;
    for (int i = 0; i < map->count; i++) {
        if (!sb_yaml_expect(&map->child[i], SB_YAML_TEXT, "a setting", err))
            return false;
        if (!sb_measure_set(&suite->measure, map->key[i].text, map->child[i].text, err))
            return sb_yaml_prefix(&map->key[i], err);
    }
    return true;
}

bool sb_draft_head(const struct sb_yaml *root, struct sb_suite *suite,
                   struct sb_error *err)
{
    const struct sb_yaml *node;
    suite->name = sb_yaml_get(root, "suite")->text;
    if ((node = sb_yaml_get(root, "about"))) {
        if (!sb_yaml_expect(node, SB_YAML_TEXT, "about", err))
            return false;
        suite->about = node->text;
    }
    return !(node = sb_yaml_get(root, "measure")) || read_measure(node, suite, err);
}

bool sb_draft_read(const struct sb_yaml *root, struct sb_suite *suite,
                   struct sb_draft *draft, struct sb_error *err)
{
    const struct sb_yaml *node;
    // In this order whatever the order in the file: base has the last word over target.
    return (!(node = sb_yaml_get(root, "scene")) ||
            read_scene(node, suite, draft, err)) &&
           (!(node = sb_yaml_get(root, "target")) ||
            read_target(node, suite, draft, err)) &&
           (!(node = sb_yaml_get(root, "base")) || read_base(node, suite, draft, err)) &&
           (!(node = sb_yaml_get(root, "exclude")) ||
            read_exclude(node, suite, draft, err)) &&
           (!(node = sb_yaml_get(root, "sweep")) ||
            read_dimensions(node, "sweep", suite, draft, &draft->sweep, err)) &&
           (!(node = sb_yaml_get(root, "cross")) ||
            read_dimensions(node, "cross", suite, draft, &draft->cross, err));
}

static void remove_axis(struct sb_dimensions *dimensions, int axis)
{
    int kept = 0;
    for (int i = 0; i < dimensions->count; i++)
        if (dimensions->row[i].axis != axis)
            dimensions->row[kept++] = dimensions->row[i];
    dimensions->count = kept;
}

static bool fail_assignment(const struct sb_assignment *assignment, struct sb_error *err)
{
    return sb_fail(err, err->status, "%s: %s", assignment->origin, err->text);
}

static bool forget_axes(const struct sb_assignment *assignment, int count,
                        const struct sb_suite *suite, struct sb_draft *draft,
                        struct sb_error *err)
{
    for (int i = 0; i < count; i++) {
        const int axis = sb_axes_expect(&suite->axes, assignment[i].axis, err);
        if (axis < 0)
            return fail_assignment(&assignment[i], err);
        remove_axis(&draft->sweep, axis);
        remove_axis(&draft->cross, axis);
    }
    return true;
}

static bool assign_dimensions(const struct sb_assignment *assignment, int count,
                              struct sb_suite *suite, struct sb_draft *draft,
                              struct sb_dimensions *to, struct sb_error *err)
{
    for (int i = 0; i < count; i++) {
        const int axis = sb_axes_find(&suite->axes, assignment[i].axis);
        struct sb_values values = {.count = 0};
        if (!sb_values_add(&suite->axes, axis, assignment[i].values, &values, err) ||
            !add_dimension(suite, draft, to, axis, &values, err))
            return fail_assignment(&assignment[i], err);
    }
    return true;
}

bool sb_draft_assign(const struct sb_suite_params *params, struct sb_suite *suite,
                     struct sb_draft *draft, struct sb_error *err)
{
    if (!forget_axes(params->set, params->set_count, suite, draft, err) ||
        !forget_axes(params->sweep, params->sweep_count, suite, draft, err) ||
        !forget_axes(params->cross, params->cross_count, suite, draft, err))
        return false;
    for (int i = 0; i < params->set_count; i++) {
        const int axis = sb_axes_find(&suite->axes, params->set[i].axis);
        if (!sb_variant_set(&suite->axes, &draft->base, axis, params->set[i].values, err))
            return fail_assignment(&params->set[i], err);
    }
    return assign_dimensions(params->sweep, params->sweep_count, suite, draft,
                             &draft->sweep, err) &&
           assign_dimensions(params->cross, params->cross_count, suite, draft,
                             &draft->cross, err);
}
