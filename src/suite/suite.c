#include <string.h>

#include "base/file.h"
#include "base/words.h"
#include "suite/draft.h"

static const struct sb_yaml *load_preset(const char *name, const char *data_dir,
                                         struct sb_arena *arena, struct sb_error *err)
{
    if (!data_dir) {
        sb_fail(err, SB_BAD_INPUT, "preset \"%s\": no data folder to look in", name);
        return NULL;
    }
    char *folder = sb_path_join(arena, data_dir, "bench/presets");
    char *path = sb_path_join(arena, folder, sb_arena_printf(arena, "%s.yaml", name));
    if (sb_suite_name_valid(name) && sb_file_exists(path))
        return sb_yaml_load(arena, path, err);
    int count = 0;
    char **names = NULL; // of a data folder without presets: none
    if (sb_dir_exists(folder) &&
        !(names = sb_dir_list(arena, folder, ".yaml", &count, err)))
        return NULL;
    for (int i = 0; i < count; i++)
        *strrchr(names[i], '.') = '\0';
    sb_fail_unknown(err, folder, "preset", name, (const char *const *)names, count);
    return NULL;
}

// What a plan is read from, and in this order: the later file has the last word.
struct files {
    const struct sb_yaml *suite;   // NULL: the command line alone
    const struct sb_yaml **preset; // side by side
    const char **preset_name;
    int preset_count;
};

// `where` is the word in the suite; NULL: it stood on the command line.
static bool add_preset(const struct sb_suite_params *params, const char *name,
                       const struct sb_yaml *where, struct sb_arena *arena,
                       struct files *files, struct sb_error *err)
{
    const struct sb_yaml *root = load_preset(name, params->data_dir, arena, err);
    if (!root && where)
        return sb_yaml_prefix(where, err);
    if (!root || !sb_draft_keys(root, true, err))
        return false;
    files->preset[files->preset_count] = root;
    files->preset_name[files->preset_count++] = name;
    return true;
}

// The presets that the command line names, else those of the suite.
static bool find_presets(const struct sb_suite_params *params, struct sb_arena *arena,
                         struct files *files, struct sb_error *err)
{
    const struct sb_yaml *node =
        files->suite ? sb_yaml_get(files->suite, "preset") : NULL;
    const bool list = node && node->kind == SB_YAML_LIST;
    int room = list ? node->count : 1;
    for (const char *p = params->preset ? params->preset : ""; *p; p++)
        room += *p == ',';
    files->preset = sb_arena_alloc(arena, (size_t)room * sizeof(struct sb_yaml *));
    files->preset_name = sb_arena_alloc(arena, (size_t)room * sizeof *files->preset_name);
    char *rest = params->preset ? sb_arena_strdup(arena, params->preset) : NULL;
    for (char *name = rest; name; name = rest) {
        rest = strchr(name, ',');
        if (rest)
            *rest++ = '\0';
        if (!add_preset(params, name, NULL, arena, files, err))
            return false;
    }
    if (!node || params->preset)
        return true;
    if (list && node->count == 0)
        return sb_yaml_fail(node, err, "preset: an empty list");
    for (int i = 0; i < (list ? node->count : 1); i++) {
        const struct sb_yaml *name = list ? &node->child[i] : node;
        if (!sb_yaml_expect(name, SB_YAML_TEXT, "preset", err) ||
            !add_preset(params, name->text, name, arena, files, err))
            return false;
    }
    return true;
}

// The plan of one part under one preset; NULL: there is none.
static bool add_plan(const struct sb_suite_params *params, const struct files *files,
                     int preset, const struct sb_yaml *part, struct sb_suite *suite,
                     struct sb_error *err)
{
    const char *scene =
        params->scene ? sb_arena_strdup(&suite->arena, params->scene) : "containers";
    struct sb_draft draft = {.origin = params->path ? params->path : "command line",
                             .scene = &scene,
                             .scene_count = 1};
    sb_variant_init(&suite->axes, &draft.base);
    if (preset < files->preset_count) {
        draft.preset = files->preset_name[preset];
        if (!sb_draft_read(files->preset[preset], suite, &draft, err))
            return false;
        memcpy(draft.preset_given, draft.base.given, sizeof draft.preset_given);
        memset(draft.base.given, 0, sizeof draft.base.given);
    }
    if ((files->suite && !sb_draft_read(files->suite, suite, &draft, err)) ||
        (part && !sb_draft_read(part, suite, &draft, err)))
        return false;
    if (params->scene) {
        draft.scene = &scene;
        draft.scene_count = 1;
    }
    return sb_draft_assign(params, suite, &draft, err) &&
           sb_draft_expand(&draft, suite, err);
}

static bool add_plans(const struct sb_suite_params *params, const struct files *files,
                      struct sb_suite *suite, struct sb_error *err)
{
    const struct sb_yaml *parts =
        files->suite ? sb_yaml_get(files->suite, "parts") : NULL;
    const int presets = files->preset_count ? files->preset_count : 1;
    for (int i = 0; i < presets; i++)
        for (int k = 0; k < (parts ? parts->count : 1); k++)
            if (!add_plan(params, files, i, parts ? &parts->child[k] : NULL, suite, err))
                return false;
    return suite->entry_count > 0 ||
           sb_fail(err, SB_BAD_INPUT, "%s: no variant is left: all %d are excluded",
                   params->path ? params->path : "command line", suite->excluded);
}

static bool read_heads(const struct files *files, struct sb_suite *suite,
                       struct sb_error *err)
{
    for (int i = 0; i < files->preset_count; i++)
        if (!sb_draft_head(files->preset[i], suite, err))
            return false;
    if (files->preset_count > 1) { // it is none of them
        suite->name = "presets";
        suite->about = "";
    }
    return !files->suite || sb_draft_head(files->suite, suite, err);
}

static bool load(const struct sb_suite_params *params, struct sb_suite *suite,
                 struct sb_error *err)
{
    struct files files = {0};
    suite->axes = *sb_axes_builtin();
    suite->name = "command-line";
    suite->about = "";
    sb_measure_defaults(&suite->measure);
    if (params->path) {
        files.suite = sb_yaml_load(&suite->arena, params->path, err);
        if (!files.suite || !sb_draft_keys(files.suite, false, err))
            return false;
    }
    if (!find_presets(params, &suite->arena, &files, err))
        return false;
    for (int i = 0; i < files.preset_count; i++)
        if (!sb_draft_axes(files.preset[i], suite, err))
            return false;
    if (files.suite && (!sb_draft_axes(files.suite, suite, err) ||
                        !sb_draft_expect(files.suite, suite, err)))
        return false;
    return read_heads(&files, suite, err) && add_plans(params, &files, suite, err);
}

bool sb_suite_load(const struct sb_suite_params *params, struct sb_suite *suite,
                   struct sb_error *err)
{
    struct sb_error unread;
    return load(params, suite, err ? err : &unread);
}

void sb_suite_free(struct sb_suite *suite)
{
    sb_arena_free(&suite->arena);
    *suite = (struct sb_suite){0};
}
