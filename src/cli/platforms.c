#include "cli/platforms.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "base/process.h"
#include "base/words.h"
#include "measure/interrupt.h"
#include "results/rows.h"

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

// Options that concern the whole, not its runs; those with a value take the next word along.
static bool is_left_out(const char *word, bool *takes_value)
{
    static const struct {
        const char *name;
        bool value;
    } own[] = {{"-o", true},      {"--output", true}, {"--write", true},
               {"--json", false}, {"--check", false}, {"--fail-on-inconclusive", false}};
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

static const char **words_of(const struct sb_platforms_run *run, const char *program,
                             const char *label, struct sb_arena *arena)
{
    const size_t count = json_array_size(run->arguments);
    const char **words = sb_arena_alloc(arena, (count + 8) * sizeof *words);
    int n = 0;
    words[n++] = sb_arena_strdup(arena, program);
    words[n++] = sb_arena_strdup(arena, "run");
    for (size_t i = 0; i < count; i++) {
        const char *word = json_string_value(json_array_get(run->arguments, i));
        bool takes_value = false;
        if (!is_left_out(word, &takes_value))
            words[n++] = sb_arena_strdup(arena, word);
        i += takes_value;
    }
    words[n++] = sb_arena_strdup(arena, "--platform");
    words[n++] = sb_arena_strdup(arena, label);
    words[n++] = sb_arena_strdup(arena, "-o");
    words[n++] = sb_arena_printf(arena, "%s/%s", run->dir, label);
    return words;
}

static int run_one(const struct sb_platforms_run *run, const char *program,
                   const char *label)
{
    struct sb_arena arena = {0};
    struct sb_error err = {0};
    int exit_code = -1;
    const struct sb_process_params params = {
        .words = words_of(run, program, label, &arena),
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

int sb_platforms_run(const struct sb_platforms_run *run, struct sb_platforms_rows *rows)
{
    struct sb_error err = {0};
    const char *program = sb_executable(&rows->arena, &err);
    int code = 0;
    if (!program || !sb_dir_make(run->dir, &err))
        return sb_cli_fail(&err);
    if (sb_file_exists(sb_path_join(&rows->arena, run->dir, "summary.csv"))) {
        sb_fail(&err, SB_BAD_INPUT,
                "%s holds results already; name another folder with -o", run->dir);
        return sb_cli_fail(&err);
    }
    rows->row = sb_alloc(((size_t)run->suite->entry_count + 1) * sizeof *rows->row);
    for (int i = 0; i < run->platforms->count; i++) {
        const char *label = run->platforms->label[i];
        if (sb_interrupted()) {
            sb_warn("%s was not run; do so with --platform %s", label, label);
            code = sb_exit_code_worse(code, sb_status_rows[SB_INTERRUPTED].exit_code);
            continue;
        }
        sb_info("platform %d of %d: %s", i + 1, run->platforms->count, label);
        code = sb_exit_code_worse(code, run_one(run, program, label));
        take_rows(run, label, rows);
    }
    return sb_exit_code_worse(code, write_summary(run, rows));
}

void sb_platforms_rows_free(struct sb_platforms_rows *rows)
{
    free(rows->row);
    sb_arena_free(&rows->arena);
    *rows = (struct sb_platforms_rows){0};
}
