// The hard cases of both sides, each by a `shadebench verify` of its own: verdicts are exact, so
// there is nothing to repeat.
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/log.h"
#include "base/process.h"
#include "cases/case.h"
#include "cli/gate.h"
#include "measure/interrupt.h"
#include "results/csv.h"

enum { WORDS_MAX = 24 + SB_CASES_MAX };

// Appends what --cases names, as words of verify: none for all of them.
static bool add_cases(const char *list, const char **words, int *count,
                      struct sb_arena *arena, struct sb_error *err)
{
    const struct sb_case *it[SB_CASES_MAX];
    int selected = 0;
    if (strcmp(list, "all") == 0)
        return true;
    for (char *word = sb_arena_strdup(arena, list), *rest; word; word = rest) {
        rest = strchr(word, ',');
        if (rest)
            *rest++ = '\0';
        if (!sb_cases_select(word, it, &selected, err))
            return sb_fail(err, SB_USAGE, "--cases: %s; or all", err->text);
    }
    for (int i = 0; i < selected; i++)
        words[(*count)++] = it[i]->id;
    return true;
}

bool sb_gate_cases_check(const char *list, struct sb_error *err)
{
    const char *words[WORDS_MAX];
    struct sb_arena arena = {0};
    int count = 0;
    const bool good = !list || add_cases(list, words, &count, &arena, err);
    sb_arena_free(&arena);
    return good;
}

// True where it has judged: exit code 0, or 1 with cases that fail.
static bool verify(const struct sb_gate_params *params, int side, const char *list,
                   const struct sb_lifeline *line, const char *dir,
                   struct sb_arena *arena, struct sb_error *err)
{
    const struct sb_context_params *context = &params->side[side].driver.context;
    const char *shaders = params->side[side].shaders;
    int count = 0, exit_code = -1;
    const char *words[WORDS_MAX + 1] = {0};
    const char *const first[] = {sb_executable(arena, err),
                                 "verify",
                                 "--form",
                                 "robust",
                                 "--data",
                                 params->data_dir,
                                 "-o",
                                 dir,
                                 "--context",
                                 context->context,
                                 "--api",
                                 context->gles ? "gles" : "gl",
                                 "--quiet"};
    if (!first[0])
        return false;
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        words[count++] = first[i];
    if (shaders)
        words[count++] = sb_arena_printf(arena, "--shaders=%s", shaders);
    if (context->device >= 0)
        words[count++] = sb_arena_printf(arena, "--device=%d", context->device);
    if (!add_cases(list, words, &count, arena, err))
        return false;
    const int settings = context->environment_count;
    const char **setting = sb_arena_alloc(arena, ((size_t)settings + 1) * sizeof(char *));
    for (int i = 0; i < settings; i++)
        setting[i] = context->environment[i];
    setting[settings] = line->setting;
    const struct sb_process_params process = {
        .words = words,
        .environment = setting,
        .environment_count = settings + 1,
        .output = SB_STREAM_DROPPED,
    };
    if (!sb_process_run(&process, &exit_code, err))
        return false;
    if (exit_code == sb_status_rows[SB_INTERRUPTED].exit_code)
        return sb_fail(err, SB_INTERRUPTED, "interrupted at the hard cases of %s",
                       sb_side_names[side]);
    return exit_code <= 1 ||
           sb_fail(err, SB_INTERNAL,
                   "the hard cases of %s cannot be judged: shadebench verify ended with "
                   "exit code %d, above is why",
                   sb_side_names[side], exit_code);
}

static bool same_cell(const struct sb_case_row *a, const struct sb_case_row *b)
{
    const char *const texts[][2] = {{a->id, b->id},
                                    {a->form, b->form},
                                    {a->stage, b->stage},
                                    {a->precision, b->precision}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (strcmp(texts[i][0] ? texts[i][0] : "", texts[i][1] ? texts[i][1] : "") != 0)
            return false;
    return true;
}

static bool is(const struct sb_case_row *row, const char *verdict)
{
    return row->verdict && strcmp(row->verdict, verdict) == 0;
}

// One line of what was lost, for the terminal and for other programs.
static void tell(const struct sb_case_row *before, const struct sb_case_row *now,
                 struct sb_gate_lost *lost)
{
    lost->it = sb_grow(lost->it, lost->count, &lost->capacity, sizeof *lost->it);
    struct sb_gate_lost_case *one = &lost->it[lost->count++];
    one->cell =
        sb_arena_printf(&lost->arena, "%s %s %s", now->id, now->stage ? now->stage : "",
                        now->precision ? now->precision : "");
    one->says = sb_arena_printf(
        &lost->arena, "base passes with %s %g, head fails with %s %g, bound %g%s%s",
        before->figure ? before->figure : "", before->measured,
        now->figure ? now->figure : "", now->measured, now->bound, now->of ? ", of " : "",
        now->of ? now->of : "");
    sb_warn("hard case %s: %s", one->cell, one->says);
}

static bool find_lost(const struct sb_csv *base, const struct sb_csv *head,
                      struct sb_gate_lost *lost, struct sb_error *err)
{
    for (int i = 1; i < head->row_count; i++) {
        struct sb_case_row now, before;
        sb_case_row_init(&now);
        if (!sb_csv_get(head, i, sb_case_columns, sb_case_column_count, &now, err))
            return false;
        if (!is(&now, "fail"))
            continue;
        for (int k = 1; k < base->row_count; k++) {
            sb_case_row_init(&before);
            if (!sb_csv_get(base, k, sb_case_columns, sb_case_column_count, &before, err))
                return false;
            if (!same_cell(&before, &now) || !is(&before, "pass"))
                continue;
            tell(&before, &now, lost);
            break;
        }
    }
    return true;
}

bool sb_gate_cases(const struct sb_gate_params *params, const char *list,
                   struct sb_gate_lost *lost, struct sb_error *err)
{
    struct sb_arena arena = {0};
    struct sb_csv csv[SB_SIDES] = {{0}};
    struct sb_lifeline line;
    if (!sb_lifeline_open(&line, err))
        return false;
    bool good = true;
    for (int side = 0; good && side < SB_SIDES && !lost->unknown; side++) {
        const char *dir =
            sb_arena_printf(&arena, "%s/cases-%s", params->dir, sb_side_names[side]);
        sb_info("verifying the hard cases of %s", sb_side_names[side]);
        good = verify(params, side, list, &line, dir, &arena, err) &&
               sb_csv_read(sb_path_join(&arena, dir, "cases.csv"), &csv[side], err);
        if (!good && side == SB_BASE && err->status != SB_INTERRUPTED) {
            sb_warn("%s; head's have nothing to be held against", err->text);
            *err = (struct sb_error){0};
            good = lost->unknown = true;
        }
    }
    if (good && !lost->unknown)
        good = find_lost(&csv[SB_BASE], &csv[SB_HEAD], lost, err);
    sb_lifeline_close(&line);
    for (int side = 0; side < SB_SIDES; side++)
        sb_csv_free(&csv[side]);
    sb_arena_free(&arena);
    return good;
}

void sb_gate_lost_free(struct sb_gate_lost *lost)
{
    free(lost->it);
    sb_arena_free(&lost->arena);
    *lost = (struct sb_gate_lost){0};
}
