// The hard cases of both sides, each by a `shadebench verify` of its own: verdicts are exact, so
// there is nothing to repeat.
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/environment.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/gate.h"
#include "results/csv.h"

// True where it has judged: exit code 0, or 1 with cases that fail.
static bool verify(const struct sb_gate_params *params, int side, const char *program,
                   const char *dir)
{
    int status = 0;
    const struct sb_context_params *context = &params->side[side].driver.context;
    const char *const words[] = {program,     "verify",
                                 "--form",    "robust",
                                 "--shaders", params->side[side].shaders,
                                 "--data",    params->data_dir,
                                 "-o",        dir,
                                 "--context", context->context,
                                 "--api",     context->gles ? "gles" : "gl",
                                 "--quiet",   "--json",
                                 NULL};
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        if (!freopen("/dev/null", "w", stdout))
            _exit(126);
        sb_environment_apply(context->environment, context->environment_count);
        execv(program, (char *const *)words);
        _exit(127);
    }
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    return pid > 0 && WIFEXITED(status) && WEXITSTATUS(status) <= 1;
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

static int count_lost(const struct sb_csv *base, const struct sb_csv *head,
                      struct sb_error *err)
{
    int lost = 0;
    for (int i = 1; i < head->row_count; i++) {
        struct sb_case_row now, before;
        sb_case_row_init(&now);
        if (!sb_csv_get(head, i, sb_case_columns, sb_case_column_count, &now, err))
            return -1;
        if (!is(&now, "fail"))
            continue;
        for (int k = 1; k < base->row_count; k++) {
            sb_case_row_init(&before);
            if (!sb_csv_get(base, k, sb_case_columns, sb_case_column_count, &before, err))
                return -1;
            if (!same_cell(&before, &now) || !is(&before, "pass"))
                continue;
            sb_warn(
                "hard case %s (%s, %s): base passes with %s %g, head fails with %s %g, "
                "bound %g%s%s",
                now.id, now.stage ? now.stage : "", now.precision ? now.precision : "",
                before.figure ? before.figure : "", before.measured,
                now.figure ? now.figure : "", now.measured, now.bound,
                now.of ? ", of " : "", now.of ? now.of : "");
            lost++;
            break;
        }
    }
    return lost;
}

int sb_gate_cases(const struct sb_gate_params *params, struct sb_error *err)
{
    struct sb_arena arena = {0};
    struct sb_csv csv[SB_SIDES] = {{0}};
    const char *program = sb_executable(&arena, err);
    int lost = -1;
    for (int side = 0; program && side < SB_SIDES; side++) {
        const char *dir =
            sb_arena_printf(&arena, "%s/cases-%s", params->dir, sb_side_names[side]);
        sb_info("verifying the hard cases of %s", sb_side_names[side]);
        if (!verify(params, side, program, dir)) {
            sb_fail(
                err, SB_INTERNAL,
                "the hard cases of %s cannot be judged: shadebench verify --shaders %s "
                "tells why",
                sb_side_names[side], params->side[side].shaders);
            goto done;
        }
        if (!sb_csv_read(sb_path_join(&arena, dir, "cases.csv"), &csv[side], err))
            goto done;
    }
    if (program)
        lost = count_lost(&csv[SB_BASE], &csv[SB_HEAD], err);
done:
    sb_csv_free(&csv[SB_BASE]);
    sb_csv_free(&csv[SB_HEAD]);
    sb_arena_free(&arena);
    return lost;
}
