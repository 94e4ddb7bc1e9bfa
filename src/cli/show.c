// shadebench show: the final GLSL of a variant, or the plan of a suite. Needs no GL.
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "assemble/assemble.h"
#include "assemble/platform.h"
#include "base/file.h"
#include "cli/show.h"
#include "cli/table.h"
#include "scene/scene.h"

static bool assemble(const struct sb_options *options, const char *data,
                     const struct sb_suite *suite, const struct sb_plan_entry *entry,
                     struct sb_assembly *assembly, struct sb_error *err)
{
    struct sb_caps caps;
    struct sb_context_params context = {0};
    if (!sb_platform_apply(suite, &context, err))
        return false;
    sb_caps_ideal(context.gles, &caps);
    const struct sb_assemble_params params = {
        .data_dir = data,
        .shaders = options->shaders,
        .axes = &suite->axes,
        .suite = suite,
        .scene = entry->scene,
        .variant = &entry->variant,
        .caps = &caps,
        .id = 1,
    };
    return sb_assemble(&params, assembly, err) &&
           (!options->validate || sb_assembly_validate(assembly, err));
}

static const char *const stage_names[] = {"vertex", "geometry", "fragment"};

static void source_texts(const struct sb_program *program, const char *text[static 3])
{
    text[0] = program->vertex;
    text[1] = program->geometry; // NULL: it has none
    text[2] = program->fragment;
}

static json_t *programs_json(const struct sb_job *job)
{
    json_t *programs = json_array();
    for (int i = 0; i < job->program_count; i++) {
        json_t *object = json_pack("{ss}", "role", job->program[i].role);
        const char *text[3];
        source_texts(&job->program[i], text);
        for (int stage = 0; stage < 3; stage++)
            if (text[stage])
                json_object_set_new(object, stage_names[stage], json_string(text[stage]));
        json_array_append_new(programs, object);
    }
    return programs;
}

static void print_programs(const struct sb_job *job, const char *id)
{
    for (int i = 0; i < job->program_count; i++) {
        const char *text[3];
        source_texts(&job->program[i], text);
        for (int stage = 0; stage < 3; stage++)
            if (text[stage])
                printf("// %s: program %s, %s shader\n%s\n", id, job->program[i].role,
                       stage_names[stage], text[stage]);
    }
}

static bool show_sources(const struct sb_options *options, const char *data,
                         const struct sb_suite *suite, struct sb_error *err)
{
    struct sb_assembly assembly = {0};
    const bool good = assemble(options, data, suite, &suite->entry[0], &assembly, err);
    if (good && options->json) {
        json_t *object = json_object();
        json_object_set_new(object, "variant", json_string(suite->entry[0].id));
        json_object_set_new(object, "programs", programs_json(&assembly.job));
        json_object_set_new(object, "source_hash",
                            json_sprintf("%016" PRIx64, assembly.source_hash));
        sb_cli_print_json(object);
    } else if (good) {
        print_programs(&assembly.job, suite->entry[0].id);
    }
    sb_assembly_free(&assembly);
    return good;
}

static bool show_plan(const struct sb_options *options, const char *data,
                      const struct sb_suite *suite, struct sb_error *err)
{
    struct sb_table *table = sb_table_new();
    json_t *list = json_array();
    bool good = true;
    sb_table_column(table, "scene", false);
    sb_table_column(table, "variant", false);
    sb_table_column(table, "source hash", false);
    for (int i = 0; good && i < suite->entry_count; i++) {
        const struct sb_plan_entry *entry = &suite->entry[i];
        struct sb_assembly assembly = {0};
        char hash[32] = "";
        good = assemble(options, data, suite, entry, &assembly, err);
        snprintf(hash, sizeof hash, "%016" PRIx64, assembly.source_hash);
        sb_assembly_free(&assembly);
        sb_table_cell(table, entry->scene);
        sb_table_cell(table, entry->id);
        sb_table_cell(table, hash);
        json_array_append_new(list, json_pack("{ssssss}", "scene", entry->scene,
                                              "variant", entry->id, "source_hash", hash));
    }
    if (good && options->json) {
        sb_cli_print_json(json_incref(list));
    } else if (good) {
        sb_table_print(table);
        printf("%d variants; %d equal ones and %d excluded left out%s\n",
               suite->entry_count, suite->duplicates, suite->excluded,
               options->validate ? "; all sources are valid" : "");
    }
    json_decref(list);
    sb_table_free(&table);
    return good;
}

static bool names_scene(const char *word)
{
    for (int i = 0; i < sb_scene_row_count; i++)
        if (strcmp(sb_scene_rows[i].name, word) == 0)
            return true;
    return false;
}

int sb_cmd_show(const struct sb_options *given, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_suite suite = {0};
    struct sb_options options = *given;
    const char *word = given->word_count ? given->word[0] : "default";
    const bool is_scene = given->effects && names_scene(word);
    const bool is_variant = strchr(word, '=') || strcmp(word, "default") == 0;
    const char *path = NULL;
    const char *data = sb_data_dir(&arena, given->data, &err);
    bool good = data != NULL;
    if (given->word_count > 1)
        good = !sb_cli_fail_axis("word", given->word[1], NULL, &err) &&
               sb_fail(&err, SB_USAGE,
                       "show takes one variant or suite; \"%s\" is one too many",
                       given->word[1]);
    if (good && is_scene)
        options.scene = word;
    else if (good && is_variant)
        good = sb_cli_add_variant(word, &options, &arena, &err);
    else if (good)
        good = (path = sb_cli_suite_path(word, data, &arena, &err)) != NULL;
    good = good && sb_cli_load_suite(&options, path, data, &suite, &err);
    if (good)
        good = given->effects ? sb_show_effects(&options, &suite, &err)
               : is_variant && suite.entry_count == 1
                   ? show_sources(&options, data, &suite, &err)
                   : show_plan(&options, data, &suite, &err);
    sb_suite_free(&suite);
    sb_arena_free(&arena);
    return good ? 0 : sb_cli_fail(&err);
}
