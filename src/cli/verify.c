// shadebench verify --classes: do variants that differ only in how they do it draw the same
// picture? Without it, the hard cases: verify_cases.c.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "cli/common.h"
#include "cli/table.h"
#include "cli/verify.h"
#include "measure/classes.h"

struct report {
    const struct sb_suite *suite;
    const struct sb_driver *driver;
    const struct sb_classes *classes;
};

// The entry that a class is called by.
static const struct sb_plan_entry *entry_of(const struct report *report, int class)
{
    int i = 0;
    while (report->classes->member[i].class != class)
        i++;
    return &report->suite->entry[i];
}

static const char *verdict_of(const struct sb_class *class)
{
    if (class->status != SB_OK)
        return sb_status_rows[class->status].word;
    return class->drawn < 2 ? "nothing to compare"
           : class->exact   ? "ok"
                            : "not held to it";
}

static void print_table(const struct report *report)
{
    struct sb_table *table = sb_table_new();
    static const char *const titles[] = {
        "scene", "class", "members", "drawn", "largest difference", "verdict"};
    for (int i = 0; i < 6; i++)
        sb_table_column(table, titles[i], i >= 2 && i <= 4);
    for (int i = 0; i < report->classes->count; i++) {
        const struct sb_class *class = &report->classes->row[i];
        const struct sb_plan_entry *entry = entry_of(report, i);
        struct sb_text text = {0};
        sb_table_cell(table, entry->scene);
        sb_class_name(report->suite, entry, &text);
        sb_table_cell(table, sb_text_get(&text));
        const double cell[] = {class->members, class->drawn, class->spread};
        for (int c = 0; c < 3; c++) {
            char number[32] = "";
            if (!isnan(cell[c]))
                snprintf(number, sizeof number, "%.3g", cell[c]);
            sb_table_cell(table, number);
        }
        sb_table_cell(table, verdict_of(class));
        sb_text_free(&text);
    }
    sb_table_print(table);
    sb_table_free(&table);
}

// Other members of the class that have the same words to say; -1: one before this has said it.
static int count_others(const struct sb_classes *classes, int entry, int entry_count)
{
    const struct sb_class_member *member = &classes->member[entry];
    int others = 0;
    for (int i = 0; i < entry_count; i++) {
        const struct sb_class_member *other = &classes->member[i];
        if (i == entry || other->class != member->class || !other->note ||
            strcmp(other->note, member->note) != 0)
            continue;
        if (i < entry)
            return -1;
        others++;
    }
    return others;
}

static void print_note(const struct report *report, int i)
{
    const struct sb_class_member *member = &report->classes->member[i];
    const struct sb_plan_entry *entry = &report->suite->entry[i];
    const int others = count_others(report->classes, i, report->suite->entry_count);
    if (others < 0)
        return;
    printf("%s: %s: %s", entry->scene,
           member->status == SB_OVER_LIMIT ? "n/a" : sb_status_rows[member->status].word,
           entry->id);
    if (others)
        printf(" and %d more of its class", others);
    printf(": %s\n", member->note);
}

static void print_members(const struct report *report)
{
    for (int i = 0; i < report->suite->entry_count; i++) {
        const struct sb_class_member *member = &report->classes->member[i];
        const struct sb_plan_entry *entry = &report->suite->entry[i];
        if (member->note)
            print_note(report, i);
        if (member->same_code >= 0)
            printf("%s: %s: same code as %s\n", entry->scene, entry->id,
                   report->suite->entry[member->same_code].id);
    }
}

static void print_text(const struct report *report)
{
    const struct sb_classes *classes = report->classes;
    int over = 0, failed = 0;
    for (int i = 0; i < report->suite->entry_count; i++) {
        const enum sb_status status = classes->member[i].status;
        over += status == SB_OVER_LIMIT;
        failed += status != SB_OVER_LIMIT && sb_status_rows[status].exit_code != 0;
    }
    printf("driver: %s, %s\n\n", report->driver->caps.renderer,
           report->driver->caps.version);
    print_table(report);
    print_members(report);
    printf(
        "\n%d variants in %d classes, %d pairs of pictures compared: %d failed, %d not "
        "to be had here\n",
        report->suite->entry_count, classes->count, classes->compared, failed, over);
}

static json_t *members_json(const struct report *report, int class)
{
    json_t *list = json_array();
    for (int i = 0; i < report->suite->entry_count; i++) {
        const struct sb_class_member *member = &report->classes->member[i];
        if (member->class != class)
            continue;
        const int same = member->same_code;
        json_array_append_new(
            list,
            json_pack("{ssssss?ss?}", "variant", report->suite->entry[i].id, "status",
                      sb_status_rows[member->status].word, "note", member->note,
                      "same_code_as", same >= 0 ? report->suite->entry[same].id : NULL));
    }
    return list;
}

static json_t *report_json(const struct report *report)
{
    json_t *list = json_array();
    for (int i = 0; i < report->classes->count; i++) {
        const struct sb_class *class = &report->classes->row[i];
        const struct sb_plan_entry *entry = entry_of(report, i);
        struct sb_text name = {0};
        sb_class_name(report->suite, entry, &name);
        json_t *object =
            json_pack("{sssssbssso}", "scene", entry->scene, "class", sb_text_get(&name),
                      "exact", class->exact, "status", sb_status_rows[class->status].word,
                      "variants", members_json(report, i));
        json_object_set_new(object, "largest_difference",
                            isfinite(class->spread) ? json_real(class->spread)
                                                    : json_null());
        json_array_append_new(list, object);
        sb_text_free(&name);
    }
    return json_pack("{sssssiso}", "renderer", report->driver->caps.renderer, "version",
                     report->driver->caps.version, "compared", report->classes->compared,
                     "classes", list);
}

static int verify_classes(const struct sb_options *options, const struct sb_suite *suite,
                          const char *data, struct sb_error *err)
{
    struct sb_driver_params params;
    struct sb_driver driver = {0};
    struct sb_classes classes = {0};
    // Nothing is timed, so Mesa may keep its shader cache: without it, it has no program
    // binaries to compare. What the user has set stays.
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 0);
    if (!sb_cli_driver_params(options, suite, &params, err) ||
        !sb_driver_connect(&params, &driver, err))
        return sb_cli_fail(err);
    const struct sb_classes_params verify = {
        .suite = suite,
        .driver = &driver,
        .data_dir = data,
        .shaders = options->shaders,
    };
    const struct report report = {suite, &driver, &classes};
    sb_info("%s: %d variants are drawn and compared", suite->name, suite->entry_count);
    sb_classes_verify(&verify, &classes);
    if (options->json)
        sb_cli_print_json(report_json(&report));
    else
        print_text(&report);
    int code = classes.exit_code;
    if (code == 0 && classes.compared == 0) {
        sb_fail(err, SB_BAD_INPUT,
                "%s: no two variants of a class were drawn, so nothing was compared",
                suite->name);
        code = sb_cli_fail(err);
    }
    sb_classes_free(&classes);
    sb_driver_close(&driver);
    return code;
}

// Options that ask for something of cases.
static bool check_classes(const struct sb_options *options, struct sb_error *err)
{
    const char *given = options->form        ? "--form"
                        : options->precision ? "--precision"
                        : options->all       ? "--all"
                        : options->breaking  ? "--breaking"
                        : options->time      ? "--time"
                        : options->search    ? "--search"
                        : options->seed      ? "--seed"
                        : options->output    ? "--output"
                        : options->timer     ? "--timer"
                                             : NULL;
    return !given || sb_fail(err, SB_USAGE, "%s is of cases: leave out --classes", given);
}

int sb_cmd_verify(const struct sb_options *given, int argc, char **argv)
{
    // Its crew are processes of their own already (cases/crew.h).
    struct sb_options here = *given;
    const struct sb_options *options = &here;
    here.in_process = true;
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_suite suite = {0};
    // The shipped suite, unless the command line has a plan of its own.
    const bool planned = options->preset || options->sweep.count || options->cross.count;
    const char *word = options->word_count ? options->word[0]
                       : planned           ? NULL
                                           : "classes";
    const char *path = NULL;
    int code;
    const char *data = sb_data_dir(&arena, options->data, &err);
    bool good = data != NULL;
    if (good && !options->classes) {
        code = sb_cli_verify_cases(options, argc, argv, data, &err);
        sb_arena_free(&arena);
        return code;
    }
    good = good && check_classes(options, &err);
    if (good && options->word_count > 1)
        good = !sb_cli_fail_axis("word", options->word[1], NULL, &err) &&
               sb_fail(&err, SB_USAGE, "verify takes one suite; \"%s\" is one too many",
                       options->word[1]);
    good = good && (!word || (path = sb_cli_suite_path(word, data, &arena, &err))) &&
           sb_cli_load_suite(options, path, data, &suite, &err);
    code = good ? verify_classes(options, &suite, data, &err) : sb_cli_fail(&err);
    sb_suite_free(&suite);
    sb_arena_free(&arena);
    return code;
}
