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

// The preset that the command line names, else that of the suite. *preset stays NULL
// where neither names one.
static bool find_preset(const struct sb_suite_params *params, const struct sb_yaml *root,
                        struct sb_arena *arena, const struct sb_yaml **preset,
                        struct sb_error *err)
{
    const struct sb_yaml *node = root ? sb_yaml_get(root, "preset") : NULL;
    if (node && !sb_yaml_expect(node, SB_YAML_TEXT, "preset", err))
        return false;
    const char *name = params->preset ? params->preset : node ? node->text : NULL;
    if (!name)
        return true;
    *preset = load_preset(name, params->data_dir, arena, err);
    if (!*preset && node && !params->preset)
        return sb_yaml_prefix(node, err);
    return *preset && sb_draft_keys(*preset, true, err);
}

static bool load(const struct sb_suite_params *params, struct sb_suite *suite,
                 struct sb_error *err)
{
    const char *scene =
        params->scene ? sb_arena_strdup(&suite->arena, params->scene) : "containers";
    struct sb_draft draft = {.origin = params->path ? params->path : "command line",
                             .scene = &scene,
                             .scene_count = 1};
    const struct sb_yaml *files[2] = {NULL, NULL}; // preset, suite: the later one wins
    suite->axes = *sb_axes_builtin();
    suite->name = "command-line";
    suite->about = "";
    sb_measure_defaults(&suite->measure);

    if (params->path) {
        files[1] = sb_yaml_load(&suite->arena, params->path, err);
        if (!files[1] || !sb_draft_keys(files[1], false, err))
            return false;
    }
    if (!find_preset(params, files[1], &suite->arena, &files[0], err))
        return false;
    for (int i = 0; i < 2; i++)
        if (files[i] && !sb_draft_axes(files[i], suite, err))
            return false;
    sb_variant_init(&suite->axes, &draft.base);
    for (int i = 0; i < 2; i++)
        if (files[i] && !sb_draft_read(files[i], suite, &draft, err))
            return false;
    if (params->scene) {
        draft.scene = &scene;
        draft.scene_count = 1;
    }
    return sb_draft_assign(params, suite, &draft, err) &&
           sb_draft_expand(&draft, suite, err);
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
