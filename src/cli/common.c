#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "assemble/platform.h"
#include "base/file.h"
#include "base/log.h"
#include "base/words.h"
#include "cli/common.h"
#include "scene/scene.h"
#include "wire/worker.h"
#ifdef SB_HAVE_GL
#include "local/local.h"
#endif

int sb_cli_fail(const struct sb_error *err)
{
    sb_warn("%s", err->text);
    return sb_status_rows[err->status].exit_code;
}

bool sb_cli_fail_axis(const char *what, const char *word, const char *value,
                      struct sb_error *err)
{
    const struct sb_axes *axes = sb_axes_builtin();
    char name[SB_NAME_MAX + 1];
    const char *equals = strchr(word, '=');
    const size_t length = equals ? (size_t)(equals - word) : strlen(word);
    if (length > SB_NAME_MAX)
        return false;
    memcpy(name, word, length);
    name[length] = '\0';
    int axis = sb_axes_find(axes, name);
    if (axis >= 0)
        value = equals ? equals + 1 : value ? value : "VALUE";
    for (int i = 0; axis < 0 && !equals && i < axes->count; i++)
        if (axes->row[i].values && sb_axis_value_find(&axes->row[i], word) >= 0) {
            axis = i;
            value = word;
        }
    if (axis < 0)
        return false;
    const bool platform = axes->row[axis].kind == SB_PLATFORM;
    sb_fail(err, SB_USAGE, "unknown %s \"%s\"; an axis is set with --%s%s%s%.*s", what,
            word, platform ? "" : "set ", axes->row[axis].name, platform ? " " : "=",
            (int)strcspn(value, ","), value);
    return true;
}

const char *sb_cli_suite_path(const char *word, const char *data_dir,
                              struct sb_arena *arena, struct sb_error *err)
{
    const char *folder = sb_path_join(arena, data_dir, "bench");
    const char *path = sb_arena_printf(arena, "%s/%s.yaml", folder, word);
    if (sb_file_exists(path))
        return path;
    if (sb_file_exists(sb_arena_printf(arena, "%s/presets/%s.yaml", folder, word))) {
        sb_fail(err, SB_USAGE, "\"%s\" is a preset: --preset %s", word, word);
        return NULL;
    }
    if (sb_cli_fail_axis("suite", word, NULL, err))
        return NULL;
    if (strchr(word, '/') || strchr(word, '.'))
        return word;
    int count;
    char **names = sb_dir_list(arena, folder, ".yaml", &count, err);
    if (!names)
        return NULL;
    for (int i = 0; i < count; i++)
        names[i][strlen(names[i]) - strlen(".yaml")] = '\0';
    sb_fail_unknown(err, "", "suite", word, (const char *const *)names, count);
    return NULL;
}

bool sb_cli_is_planned(const struct sb_options *options)
{
    const struct sb_axes *axes = sb_axes_builtin();
    bool planned =
        options->preset || options->scene || options->sweep.count || options->cross.count;
    for (int i = 0; i < options->set.count; i++) {
        const int axis = sb_axes_find(axes, options->set.item[i].axis);
        planned |= axis < 0 || axes->row[axis].kind != SB_PLATFORM;
    }
    return planned;
}

bool sb_cli_load_suite(const struct sb_options *options, const char *path,
                       const char *data_dir, struct sb_suite *suite, struct sb_error *err)
{
    const struct sb_suite_params params = {
        .path = path,
        .preset = options->preset,
        .data_dir = data_dir,
        .scene = options->scene,
        .set = options->set.item,
        .set_count = options->set.count,
        .sweep = options->sweep.item,
        .sweep_count = options->sweep.count,
        .cross = options->cross.item,
        .cross_count = options->cross.count,
    };
    if (options->shaders && !sb_dir_exists(options->shaders))
        return sb_fail(err, SB_BAD_INPUT, "--shaders %s: there is no such folder",
                       options->shaders);
    bool good = sb_suite_load(&params, suite, err);
    for (int i = 0; good && i < suite->entry_count; i++)
        good = sb_scene_expect(suite->entry[i].scene, err) != NULL;
    for (int i = 0; good && i < options->setting.count; i++)
        good = sb_measure_set(&suite->measure, options->setting.item[i].axis,
                              options->setting.item[i].values, err);
    return good;
}

bool sb_cli_add_variant(const char *word, struct sb_options *options,
                        struct sb_arena *arena, struct sb_error *err)
{
    char *const all = sb_arena_strdup(arena, word), *rest = all;
    if (strcmp(word, "default") == 0)
        return true;
    for (char *part = rest; part; part = rest) {
        rest = strchr(part, ',');
        if (rest)
            *rest++ = '\0';
        char *equals = strchr(part, '=');
        if (!equals && part == all && !options->preset) {
            options->preset = part;
            continue;
        }
        if (!equals || options->set.count == SB_ASSIGNMENTS_MAX)
            return sb_fail(err, SB_USAGE, "variant \"%s\": AXIS=VALUE,… is wanted", word);
        const char *origin = sb_arena_printf(arena, "variant \"%s\"", part);
        *equals = '\0';
        options->set.item[options->set.count++] =
            (struct sb_assignment){.axis = part, .values = equals + 1, .origin = origin};
    }
    return true;
}

static bool parse_device(const char *text, int *device, struct sb_error *err)
{
    double number = -1;
    if (text && (!sb_parse_number(text, &number) || number < 0 || number > 1024 ||
                 number != (int)number))
        return sb_fail(err, SB_USAGE, "--device %s: a whole number from 0 is wanted",
                       text);
    *device = (int)number;
    return true;
}

static bool parse_limit(const char *text, double *seconds, struct sb_error *err)
{
    *seconds = 0;
    return !text || (sb_parse_number(text, seconds) && *seconds > 0) ||
           sb_fail(err, SB_USAGE, "--worker-limit %s: seconds over 0 are wanted", text);
}

bool sb_cli_driver_params(const struct sb_options *options, const struct sb_suite *suite,
                          struct sb_driver_params *params, struct sb_error *err)
{
    *params = (struct sb_driver_params){
        .timer = options->timer,
        .context.program_cache = options->program_cache,
        .context.worker = options->worker,
        .context.driver_stats = options->driver_stats,
    };
    if (options->in_process && options->worker)
        return sb_fail(err, SB_USAGE, "--in-process has no worker: leave out --worker");
    if (!parse_limit(options->worker_limit, &params->context.worker_limit_s, err))
        return false;
    if (!sb_platform_apply(suite, &params->context, err) ||
        !parse_device(options->device, &params->context.device, err))
        return false;
    if (strcmp(params->context.context, "null") == 0)
        params->runner = options->worker ? &sb_runner_worker : &sb_runner_null;
#ifdef SB_HAVE_GL
    else
        params->runner = options->in_process ? &sb_runner_local : &sb_runner_worker;
#else
    else
        return sb_fail(err, SB_NO_GL, "built without GL: only --context null is there");
#endif
    return true;
}

bool sb_cli_pin_threads(const struct sb_suite *suite)
{
    const int axis = sb_axes_find(&suite->axes, "threads");
    if (getenv("LP_NUM_THREADS") ||
        (axis >= 0 && suite->entry[0].variant.value[axis] >= 0))
        return false;
    return setenv("LP_NUM_THREADS", "1", 1) == 0;
}

bool sb_cli_read_share(const char *option, const char *text, double *share,
                       struct sb_error *err)
{
    char number[32] = "";
    const size_t length = strlen(text);
    const bool percent = length && text[length - 1] == '%';
    if (length < sizeof number)
        memcpy(number, text, length - percent);
    if (!sb_parse_number(number, share) || *share < 0 || *share >= (percent ? 100 : 1))
        return sb_fail(err, SB_USAGE,
                       "%s %s: a share is wanted, as 2%% or 0.02, below 100%%", option,
                       text);
    if (percent)
        *share /= 100;
    return true;
}

json_t *sb_cli_arguments_json(int argc, char **argv, struct sb_error *err)
{
    json_t *list = json_array();
    for (int i = 2; i < argc; i++)
        if (argc > SB_ARGUMENTS_MAX ||
            json_array_append_new(list, json_string(argv[i])) != 0) {
            sb_fail(err, SB_USAGE,
                    "argument %d: at most %d, in UTF-8, can be kept beside the results",
                    i, SB_ARGUMENTS_MAX);
            json_decref(list);
            return NULL;
        }
    return list;
}

void sb_cli_print_json(json_t *value)
{
    char *text = json_dumps(value, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    printf("%s\n", text ? text : "null");
    free(text);
    json_decref(value);
}
