#include "cli/platforms.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "base/process.h"
#include "base/words.h"
#include "measure/interrupt.h"
#include "measure/record.h"
#include "measure/run.h"
#include "results/rows.h"
#include "results/store.h"

// --- which there are -----------------------------------------------------------------------------

static bool differs(const struct sb_suite *suite, int axis)
{
    for (int i = 1; i < suite->entry_count; i++)
        if (suite->entry[i].variant.value[axis] != suite->entry[0].variant.value[axis])
            return true;
    return false;
}

// A GLSL version is a matter of each program, not of the context.
static bool is_platform(const struct sb_axes *axes, int axis)
{
    return axes->row[axis].kind == SB_PLATFORM &&
           strcmp(axes->row[axis].name, "glsl") != 0;
}

static const char *label_of(const struct sb_suite *suite,
                            const struct sb_variant *variant, struct sb_arena *arena)
{
    const struct sb_axes *axes = &suite->axes;
    struct sb_text text = {0};
    for (int a = 0; a < axes->count; a++) {
        if (!is_platform(axes, a) || !differs(suite, a))
            continue;
        sb_text_printf(&text, "%s%s=", text.length ? "," : "", axes->row[a].name);
        const size_t before = text.length;
        sb_variant_value_text(axes, variant, a, &text);
        if (text.length == before) // moot, as threads are on a driver without any
            sb_text_add(&text, "none");
    }
    const char *label = sb_arena_strdup(arena, sb_text_get(&text));
    sb_text_free(&text);
    return label;
}

void sb_platforms_find(const struct sb_suite *suite, struct sb_platforms *platforms,
                       struct sb_arena *arena)
{
    platforms->label =
        sb_arena_alloc(arena, ((size_t)suite->entry_count + 1) * sizeof(char *));
    platforms->count = 0;
    for (int i = 0; i < suite->entry_count; i++) {
        const char *label = label_of(suite, &suite->entry[i].variant, arena);
        int at = 0;
        while (at < platforms->count && strcmp(platforms->label[at], label) != 0)
            at++;
        if (at == platforms->count)
            platforms->label[platforms->count++] = label;
    }
}

bool sb_platforms_keep(struct sb_suite *suite, const char *label, struct sb_error *err)
{
    struct sb_platforms all;
    int kept = 0;
    sb_platforms_find(suite, &all, &suite->arena);
    bool *keep = sb_alloc((size_t)suite->entry_count + 1);
    for (int i = 0; i < suite->entry_count; i++)
        keep[i] =
            strcmp(label_of(suite, &suite->entry[i].variant, &suite->arena), label) == 0;
    for (int i = 0; i < suite->entry_count; i++)
        if (keep[i])
            suite->entry[kept++] = suite->entry[i];
    free(keep);
    if (kept == 0)
        return sb_fail_unknown(err, "", "platform", label, all.label, all.count);
    suite->entry_count = kept;
    return true;
}

// --- running them --------------------------------------------------------------------------------

// Options that concern the whole, not its runs, or that each of them is given below; those with a value
// take the next word along.
static bool is_left_out(const char *word, bool *takes_value)
{
    static const struct {
        const char *name;
        bool value;
    } own[] = {{"-o", true},       {"--output", true}, {"--write", true},
               {"--json", false},  {"--check", false}, {"--fail-on-inconclusive", false},
               {"--data", true},   {"--worker", true}, {"--worker-limit", true},
               {"--quiet", false}, {"-q", false}};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        const size_t length = strlen(own[i].name);
        if (strcmp(word, own[i].name) == 0) {
            *takes_value = own[i].value;
            return true;
        }
        if (own[i].value && strncmp(word, own[i].name, length) == 0 &&
            word[length] == '=') {
            *takes_value = false;
            return true;
        }
    }
    return false;
}

struct words {
    const char **word;
    int count;
    struct sb_arena *arena;
};

static void add_word(struct words *words, const char *word)
{
    words->word[words->count++] = sb_arena_strdup(words->arena, word);
}

// What each run is given, whether it is begun or gone on with.
static void add_common(struct words *words, const struct sb_options *options)
{
    const struct {
        const char *name, *value;
    } texts[] = {{"--data", options->data},
                 {"--worker", options->worker},
                 {"--worker-limit", options->worker_limit}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (texts[i].value) {
            add_word(words, texts[i].name);
            add_word(words, texts[i].value);
        }
    if (options->quiet)
        add_word(words, "--quiet");
}

// The words that the whole was begun with. The suite may have changed since, or lie elsewhere: what
// is begun later takes the copy. They come last, for a `--` may be among them.
static void add_arguments(struct words *words, const struct sb_platforms_run *run)
{
    const struct sb_options *options = run->options;
    const size_t count = json_array_size(run->arguments);
    for (size_t i = 0; i < count; i++) {
        const char *word = json_string_value(json_array_get(run->arguments, i));
        bool takes_value = false;
        if (options->resume && options->word_count && (int)i == options->word_at[0])
            add_word(words, run->suite_file);
        else if (!is_left_out(word, &takes_value))
            add_word(words, word);
        i += takes_value;
    }
}

// The whole may have been told otherwise than the run was.
static void add_settings(struct words *words, const struct sb_platforms_run *run,
                         const char *dir)
{
    struct sb_error ignored;
    json_t *record = sb_store_read_run(dir, &ignored);
    json_t *now = sb_settings_json(&run->suite->measure);
    const json_t *was = json_object_get(record, "measure");
    const char *name;
    json_t *value;
    json_object_foreach(now, name, value)
    {
        char number[32];
        const double wanted = json_number_value(value);
        if (was && wanted != json_number_value(json_object_get(was, name)))
            words->word[words->count++] = sb_arena_printf(words->arena, "--%s=%s", name,
                                                          sb_number_text(wanted, number));
    }
    json_decref(now);
    json_decref(record);
}

static const char *const *words_of(const struct sb_platforms_run *run,
                                   const char *program, const char *label,
                                   struct sb_arena *arena)
{
    const size_t room =
        json_array_size(run->arguments) + (size_t)sb_measure_row_count + 16;
    const char *dir = sb_path_join(arena, run->dir, label);
    struct words words = {sb_arena_alloc(arena, room * sizeof(char *)), 0, arena};
    add_word(&words, program);
    add_word(&words, "run");
    if (run->options->resume && sb_file_exists(sb_path_join(arena, dir, "run.json"))) {
        add_word(&words, "--resume");
        add_word(&words, dir);
        add_common(&words, run->options);
        if (run->options->in_process)
            add_word(&words, "--in-process");
        add_settings(&words, run, dir);
    } else {
        add_word(&words, "--platform");
        add_word(&words, label);
        add_word(&words, "-o");
        add_word(&words, dir);
        add_common(&words, run->options);
        add_arguments(&words, run);
    }
    return words.word;
}

static int run_one(const struct sb_platforms_run *run, const char *program,
                   const char *label, const struct sb_lifeline *line)
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    int exit_code = -1;
    const char *const setting[] = {line->setting};
    const struct sb_process_params params = {
        .words = words_of(run, program, label, &arena),
        .environment = setting,
        .environment_count = 1,
        .output = run->quiet_output ? SB_STREAM_DROPPED : SB_STREAM_KEPT,
    };
    const bool ended = sb_process_run(&params, &exit_code, &err);
    sb_arena_free(&arena);
    if (ended)
        return exit_code;
    sb_warn("%s: %s; what it had measured is in %s/%s", label, err.text, run->dir, label);
    return sb_status_rows[err.status].exit_code;
}

// The rows of one run; texts move into the arena of all by staying where they are: the file's.
static void take_rows(const struct sb_platforms_run *run, const char *label,
                      struct sb_platforms_rows *rows)
{
    struct sb_error err = {0};
    struct sb_rows *own = sb_arena_alloc(&rows->arena, sizeof *own);
    const char *path =
        sb_arena_printf(&rows->arena, "%s/%s/summary.csv", run->dir, label);
    if (!sb_file_exists(path)) // it said why
        return;
    if (!sb_rows_read(path, &run->suite->axes, own, &err)) {
        sb_warn("%s", err.text);
        return;
    }
    for (int i = 0; i < own->count; i++) {
        struct sb_variant *axes = sb_arena_alloc(&rows->arena, sizeof *axes);
        rows->row = sb_grow(rows->row, rows->count, &rows->room, sizeof *rows->row);
        struct sb_row *row = &rows->row[rows->count++];
        *axes = own->variant[i];
        *row = own->row[i];
        row->axes = axes;
        for (int c = 0; c < sb_summary_column_count; c++) {
            const char **cell =
                (const char **)((char *)row + sb_summary_columns[c].offset);
            if (sb_summary_columns[c].type == SB_TEXT && *cell)
                *cell = sb_arena_strdup(&rows->arena, *cell);
        }
    }
    sb_rows_free(own);
}

static int write_summary(const struct sb_platforms_run *run,
                         const struct sb_platforms_rows *rows)
{
    struct sb_error err = {0};
    struct sb_arena arena = {0};
    struct sb_text text = {0};
    sb_csv_header(&text, sb_summary_columns, sb_summary_column_count, &run->suite->axes);
    for (int i = 0; i < rows->count; i++)
        sb_csv_row(&text, sb_summary_columns, sb_summary_column_count, &run->suite->axes,
                   &rows->row[i]);
    const bool good = sb_file_replace(sb_path_join(&arena, run->dir, "summary.csv"),
                                      text.data, text.length, &err);
    sb_text_free(&text);
    sb_arena_free(&arena);
    return good ? 0 : sb_cli_fail(&err);
}

// A folder of a whole is begun once, and then gone on with.
static bool begin(const struct sb_platforms_run *run, struct sb_error *err)
{
    struct sb_arena arena = {0};
    bool good = sb_dir_make(run->dir, err);
    if (good && (sb_file_exists(sb_path_join(&arena, run->dir, "run.json")) ||
                 sb_file_exists(sb_path_join(&arena, run->dir, "summary.csv"))))
        good = sb_fail(err, SB_BAD_INPUT,
                       "%s holds results already; name another folder with -o, or go on "
                       "with it: run --resume %s",
                       run->dir, run->dir);
    good =
        good && (!run->suite_file || sb_run_copy_suite(run->suite_file, run->dir, err));
    sb_arena_free(&arena);
    return good;
}

// Rows of a platform whose turn does not come are those of an earlier start.
static int run_all(const struct sb_platforms_run *run, const char *program,
                   const struct sb_lifeline *line, struct sb_platforms_rows *rows)
{
    const int interrupted = sb_status_rows[SB_INTERRUPTED].exit_code;
    struct sb_error err = {0};
    int code = 0;
    for (int i = 0; i < run->platforms->count; i++) {
        const char *label = run->platforms->label[i];
        rows->interrupted |= sb_interrupted();
        if (!rows->interrupted) {
            sb_info("platform %d of %d: %s", i + 1, run->platforms->count, label);
            const int one = run_one(run, program, label, line);
            rows->interrupted = one == interrupted;
            code = sb_exit_code_worse(code, one);
            if (!sb_platforms_record(run, &err))
                code = sb_exit_code_worse(code, sb_cli_fail(&err));
        }
        take_rows(run, label, rows);
    }
    rows->interrupted |= sb_interrupted();
    if (!rows->interrupted)
        return code;
    sb_warn("interrupted; go on with: shadebench run --resume %s", run->dir);
    return sb_exit_code_worse(code, interrupted);
}

int sb_platforms_run(const struct sb_platforms_run *run, struct sb_platforms_rows *rows)
{
    struct sb_error err = {0};
    struct sb_lifeline line;
    const char *program = sb_executable(&rows->arena, &err);
    if (!program || (!run->options->resume && !begin(run, &err)) ||
        !sb_platforms_record(run, &err) || !sb_lifeline_open(&line, &err))
        return sb_cli_fail(&err);
    const int code = run_all(run, program, &line, rows);
    sb_lifeline_close(&line);
    return sb_exit_code_worse(code, write_summary(run, rows));
}

void sb_platforms_rows_free(struct sb_platforms_rows *rows)
{
    free(rows->row);
    sb_arena_free(&rows->arena);
    *rows = (struct sb_platforms_rows){0};
}
