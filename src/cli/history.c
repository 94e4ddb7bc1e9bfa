// shadebench history: which of its two, and `add`.
#include "cli/history.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/words.h"
#include "cli/report.h"
#include "cli/shader_tree.h"
#include "cli/table.h"
#include "gate/history.h"
#include "measure/interrupt.h"
#include "results/history_file.h"
#include "results/history_time.h"
#include "stats/gate.h"

enum { USUAL_PAIRS = 60 };
// A suite's settings are those of a run. Here the pairs are counted, so time is no limit; and the
// points of a series are of different processes, so each had better be of several.
static const struct {
    const char *setting, *value;
} usual_settings[] = {{"budget", "600"}, {"processes", "3"}};

struct adding {
    const struct sb_options *options;
    const char *file, *data, *shaders, *commit;
    char time[32];
    int pairs;
    bool pinned;
    struct sb_suite suite;
    struct sb_anchor anchor;
    struct sb_history_measured measured;
    struct sb_arena arena;
};

// --- what is asked for -----------------------------------------------------------------------

// A word that stands in a CSV and in a table, and that people paste.
static bool check_commit(const char *commit, struct sb_error *err)
{
    const size_t length = strlen(commit);
    bool good = length > 0 && length <= 128;
    for (size_t i = 0; good && i < length; i++)
        good = isgraph((unsigned char)commit[i]) && !strchr(",\"", commit[i]);
    return good || sb_fail(err, SB_USAGE,
                           "--commit \"%s\": a word of up to 128 printable ASCII "
                           "characters is wanted, without commas and quotes",
                           commit);
}

static bool read_pairs(const char *text, int *pairs, struct sb_error *err)
{
    double number = USUAL_PAIRS;
    if (text && (!sb_parse_number(text, &number) || number < 6 ||
                 number > SB_GATE_PAIRS_MAX || number != floor(number)))
        return sb_fail(err, SB_USAGE, "--pairs %s: a whole number from 6 to %d is wanted",
                       text, SB_GATE_PAIRS_MAX);
    *pairs = (int)number;
    return true;
}

static bool is_set(const struct sb_options *options, const char *setting)
{
    for (int i = 0; i < options->setting.count; i++)
        if (strcmp(options->setting.item[i].axis, setting) == 0)
            return true;
    return false;
}

static bool load_suite(struct adding *adding, struct sb_error *err)
{
    const struct sb_options *options = adding->options;
    const char *word = options->word_count > 1      ? options->word[1]
                       : sb_cli_is_planned(options) ? NULL
                                                    : "ci";
    const char *path = NULL;
    if (word && !(path = sb_cli_suite_path(word, adding->data, &adding->arena, err)))
        return false;
    if (!sb_cli_load_suite(options, path, adding->data, &adding->suite, err))
        return false;
    for (size_t i = 0; i < sizeof usual_settings / sizeof *usual_settings; i++)
        if (!is_set(options, usual_settings[i].setting) &&
            !sb_measure_set(&adding->suite.measure, usual_settings[i].setting,
                            usual_settings[i].value, err))
            return false;
    return true;
}

static bool find_commit(struct adding *adding, struct sb_error *err)
{
    const struct sb_options *options = adding->options;
    adding->commit = options->commit;
    if (!adding->commit)
        adding->commit = sb_shader_commit(adding->shaders, &adding->arena, err);
    if (!adding->commit || !check_commit(adding->commit, err))
        return false;
    sb_timestamp(adding->time);
    return !options->date || sb_history_time(options->date, adding->time, err);
}

static bool prepare(struct adding *adding, struct sb_history_measure_params *params,
                    struct sb_error *err)
{
    const struct sb_options *options = adding->options;
    if (options->word_count > 2)
        return sb_fail(err, SB_USAGE,
                       "history add takes one suite; \"%s\" is one too many",
                       options->word[2]);
    adding->data = sb_data_dir(&adding->arena, options->data, err);
    if (!adding->data || !read_pairs(options->pairs, &adding->pairs, err) ||
        !load_suite(adding, err))
        return false;
    adding->shaders = options->shaders
                          ? options->shaders
                          : sb_path_join(&adding->arena, adding->data, "shaders");
    *params = (struct sb_history_measure_params){
        .suite = &adding->suite,
        .anchor = &adding->anchor,
        .pairs = adding->pairs,
        .data_dir = adding->data,
        .shaders = options->shaders,
    };
    if (!find_commit(adding, err) ||
        !sb_metric_find(options->metric, &params->metric, err) ||
        !sb_cli_driver_params(options, &adding->suite, &params->driver, err) ||
        !sb_anchor_load(adding->data, &adding->suite, params->driver.context.gles,
                        &adding->anchor, err))
        return false;
    if (params->metric == SB_METRIC_INSTRUCTIONS)
        return sb_fail(
            err, SB_USAGE,
            "--metric instructions: a history is of times; counts are for gate");
    if (options->in_process && adding->suite.measure.processes > 1)
        return sb_fail(err, SB_USAGE, "--in-process is one process: add --processes 1");
    adding->pinned = sb_cli_pin_threads(&adding->suite);
    // Before anything is measured: is there a place for it?
    return sb_history_append(adding->file, NULL, 0, err);
}

// --- what is told ----------------------------------------------------------------------------

static void print(const struct adding *adding, bool appended)
{
    const struct sb_history_measured *measured = &adding->measured;
    struct sb_table *table = sb_table_new();
    static const char *const right[] = {"ratio", "95 %", "processes", "pairs"};
    printf("history %s: commit %s of %s, held against the anchor %s\n",
           adding->suite.name, adding->commit, adding->time,
           measured->row->anchor ? measured->row->anchor : "?");
    printf("driver: %s, %s%s\nmetric: %s\n\n", measured->caps.renderer,
           measured->caps.version,
           adding->pinned && measured->caps.software
               ? ", LP_NUM_THREADS=1 (pinned; set it to keep yours)"
               : "",
           sb_metric_rows[measured->metric].name);
    sb_table_column(table, "scene", false);
    sb_table_column(table, "variant", false);
    for (int i = 0; i < 4; i++)
        sb_table_column(table, right[i], true);
    sb_table_column(table, "status", false);
    for (int i = 0; i < measured->row_count; i++) {
        const struct sb_history_row *row = &measured->row[i];
        sb_table_cell(table, row->scene);
        sb_table_cell(table, row->variant);
        sb_table_real(table, "%.4f", row->ratio);
        if (isnan(row->ratio_lo))
            sb_table_cell(table, NULL);
        else
            sb_table_cellf(table, "%.4f … %.4f", row->ratio_lo, row->ratio_hi);
        sb_table_cellf(table, "%lld", (long long)row->processes);
        sb_table_cellf(table, "%lld", (long long)row->pairs);
        sb_table_cell(table, row->status);
    }
    sb_table_print(table);
    sb_table_free(&table);
    printf("\n%.1f s; %d rows %s to %s\n", measured->seconds, measured->row_count,
           appended ? "appended" : "NOT appended", adding->file);
}

static void print_json(const struct adding *adding, bool appended)
{
    json_t *rows = json_array();
    for (int i = 0; i < adding->measured.row_count; i++) {
        json_t *row = json_object();
        for (int c = 0; c < sb_history_column_count; c++)
            json_object_set_new(
                row, sb_history_columns[c].name,
                sb_report_cell_json(&adding->measured.row[i], &sb_history_columns[c]));
        json_array_append_new(rows, row);
    }
    sb_cli_print_json(json_pack("{sssbsfso}", "file", adding->file, "appended", appended,
                                "seconds", adding->measured.seconds, "rows", rows));
}

// --- add -------------------------------------------------------------------------------------

static bool append(struct adding *adding, struct sb_error *err)
{
    struct sb_history_measured *measured = &adding->measured;
    for (int i = 0; i < measured->row_count; i++) {
        measured->row[i].time = adding->time;
        measured->row[i].commit = adding->commit;
    }
    return sb_history_append(adding->file, measured->row, measured->row_count, err);
}

static int add(const struct sb_options *options)
{
    struct sb_error err = {0};
    struct sb_history_measure_params params;
    struct adding adding = {.options = options,
                            .file = options->file ? options->file : SB_HISTORY_FILE};
    sb_interrupt_install();
    const bool measured = prepare(&adding, &params, &err) &&
                          sb_history_measure(&params, &adding.measured, &err);
    const bool appended = measured && append(&adding, &err);
    int code = measured ? adding.measured.exit_code : 0;
    // Minutes of measuring are shown, also where the disk is full by now.
    if (measured && options->json)
        print_json(&adding, appended);
    else if (measured)
        print(&adding, appended);
    if (!appended)
        code = sb_exit_code_worse(code, sb_cli_fail(&err));
    sb_history_measured_free(&adding.measured);
    sb_anchor_free(&adding.anchor);
    sb_suite_free(&adding.suite);
    sb_arena_free(&adding.arena);
    return code;
}

// --- which of the two ------------------------------------------------------------------------

// Options that only the one takes; a given one is told by any of its bytes.
#define AT(field, show)                                                                  \
    {                                                                                    \
#field, offsetof(struct sb_options, field),                                      \
            sizeof((struct sb_options *)0)->field, show                                  \
    }
static const struct {
    const char *name;
    size_t offset, size;
    bool show;
} own_options[] = {
    AT(commit, false), AT(date, false),    AT(pairs, false),  AT(metric, false),
    AT(timer, false),  AT(shaders, false), AT(scene, false),  AT(preset, false),
    AT(device, false), AT(worker, false),  AT(variant, true), AT(tolerance, true),
    AT(wide, true),    AT(check, true),    AT(recent, true),
};
#undef AT

static bool is_given(const struct sb_options *options, size_t offset, size_t size)
{
    const char *byte = (const char *)options + offset;
    for (size_t i = 0; i < size; i++)
        if (byte[i])
            return true;
    return false;
}

static bool check_options(const struct sb_options *options, bool show,
                          struct sb_error *err)
{
    for (size_t i = 0; i < sizeof own_options / sizeof *own_options; i++)
        if (own_options[i].show != show &&
            is_given(options, own_options[i].offset, own_options[i].size))
            return sb_fail(err, SB_USAGE, "--%s goes with history %s",
                           own_options[i].name, show ? "add" : "show");
    enum { LISTS = 4 };
    const struct sb_assignments *const lists[LISTS] = {
        &options->set, &options->sweep, &options->cross, &options->setting};
    for (int i = 0; show && i < LISTS; i++)
        if (lists[i]->count)
            return sb_fail(err, SB_USAGE, "%s goes with history add",
                           lists[i]->item[0].origin);
    return true;
}

int sb_cmd_history(const struct sb_options *options, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    static const char *const words[] = {"add", "show"};
    struct sb_error err = {0};
    const char *word = options->word_count ? options->word[0] : NULL;
    const bool show = word && strcmp(word, words[1]) == 0;
    if (!word)
        sb_fail(&err, SB_USAGE, "history what? valid: history add [SUITE], history show");
    else if (!show && strcmp(word, words[0]) != 0)
        sb_fail_unknown(&err, "history", "word", word, words, 2);
    else if (check_options(options, show, &err))
        return show ? sb_history_show(options) : add(options);
    return sb_cli_fail(&err);
}
