#include "wire/connection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "job/callgrind.h"
#include "wire/messages.h"

static double limit_s(const struct sb_connection *line)
{
    const double limit = line->params.worker_limit_s;
    return limit > 0 ? limit : 120;
}

static int64_t deadline(const struct sb_connection *line)
{
    return sb_clock_ns() + (int64_t)(limit_s(line) * 1e9);
}

// --- one worker ------------------------------------------------------------------------------

// Ends what is left of the worker, and says in *err how the exchange failed.
static bool lose(struct sb_connection *line, enum sb_frame_end end, const char *doing,
                 struct sb_error *err)
{
    struct sb_text how = {0};
    const struct sb_error garbage = *err;
    sb_child_end(&line->child, end == SB_FRAME_CLOSED ? 5 : 0, &how);
    if (end == SB_FRAME_GARBAGE)
        sb_fail(err, SB_WORKER_GARBAGE, "%s: the worker %s", doing, garbage.text);
    else if (end == SB_FRAME_LATE)
        sb_fail(err, SB_WORKER_HUNG,
                "%s: the worker did not answer within %g s and was killed", doing,
                limit_s(line));
    else
        sb_fail(err, SB_WORKER_CRASHED, "%s: the worker %s", doing,
                how.length ? how.data : "closed its output");
    sb_text_free(&how);
    return false;
}

bool sb_connection_receive(struct sb_connection *line, const char *doing,
                           struct sb_frame *answer, struct sb_error *err)
{
    const enum sb_frame_end end =
        sb_frame_read(line->child.fd, answer, deadline(line), err);
    return end == SB_FRAME_OK || lose(line, end, doing, err);
}

bool sb_connection_send(struct sb_connection *line, const char *doing,
                        const struct sb_frame *request, struct sb_error *err)
{
    const enum sb_frame_end end = sb_frame_write(line->child.fd, request, deadline(line));
    // A worker that could not be written to has had a reason, which may be waiting.
    return end == SB_FRAME_OK || lose(line, end, doing, err);
}

// What an answer says: false with the runner's own error; a worker that breaks the protocol is
// lost.
bool sb_connection_accept(struct sb_connection *line, const char *doing,
                          const struct sb_frame *answer, struct sb_error *err)
{
    const json_t *ok = json_object_get(answer->head, "ok");
    struct sb_error told;
    if (json_is_true(ok))
        return true;
    if (!json_is_false(ok)) {
        sb_fail(err, SB_WORKER_GARBAGE, "wrote a message that is no answer");
        return lose(line, SB_FRAME_GARBAGE, doing, err);
    }
    if (!sb_wire_get_error(json_object_get(answer->head, "error"), &told, err))
        return lose(line, SB_FRAME_GARBAGE, doing, err);
    *err = told;
    return false;
}

// Request and answer. *answer must be zeroed; it is filled only on success.
bool sb_connection_exchange(struct sb_connection *line, const char *doing,
                            const struct sb_frame *request, struct sb_frame *answer,
                            struct sb_error *err)
{
    if (!sb_connection_send(line, doing, request, err) ||
        !sb_connection_receive(line, doing, answer, err))
        return false;
    if (sb_connection_accept(line, doing, answer, err))
        return true;
    sb_frame_free(answer);
    return false;
}

bool sb_connection_lost(const struct sb_connection *line)
{
    return line->child.pid == 0;
}

// A part of an answer that cannot be read: the worker is not to be believed any more.
bool sb_connection_distrust(struct sb_connection *line, const char *doing,
                            struct sb_error *err)
{
    return lose(line, SB_FRAME_GARBAGE, doing, err);
}

static const char *default_command(struct sb_arena *arena, struct sb_error *err)
{
    char *program = sb_executable(arena, err);
    if (!program)
        return NULL;
    *strrchr(program, '/') = '\0';
    const char *beside = sb_arena_printf(arena, "%s/shadebench-worker", program);
    if (!sb_file_exists(beside)) {
        sb_fail(err, SB_BAD_INPUT,
                "%s is missing; install it, or say --in-process or --worker COMMAND",
                beside);
        return NULL;
    }
    return sb_arena_printf(arena, "exec %s", sb_shell_quote(arena, beside));
}

// The same under callgrind, in a folder of its own.
static bool count_by_callgrind(struct sb_connection *line, struct sb_error *err)
{
    static const char exec[] = "exec ";
    const char *command = line->params.worker;
    if (!sb_in_path("valgrind"))
        return sb_fail(err, SB_BAD_INPUT,
                       "valgrind is missing: install it to count instructions where the "
                       "kernel offers no counters");
    line->params.count_folder = sb_temporary_dir(&line->arena, "shadebench-count", err);
    if (!line->params.count_folder)
        return false;
    if (strncmp(command, exec, strlen(exec)) == 0)
        command += strlen(exec);
    line->params.worker = sb_arena_printf(
        &line->arena, "exec %s %s",
        sb_callgrind_command(&line->arena, line->params.count_folder), command);
    return true;
}

static bool open_context(struct sb_connection *line, struct sb_caps *caps,
                         struct sb_error *err)
{
    struct sb_frame request = {.head = sb_wire_call("open")}, answer = {0};
    sb_wire_put_open(request.head, &line->params);
    bool good =
        sb_connection_exchange(line, "opening the context", &request, &answer, err);
    if (good && !sb_wire_get_caps(json_object_get(answer.head, "caps"), caps, err))
        good = sb_connection_distrust(line, "opening the context", err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

bool sb_connection_tell_timer(struct sb_connection *line, struct sb_error *err)
{
    struct sb_frame request = {.head = sb_wire_call("use_timer")}, answer = {0};
    json_object_set_new(request.head, "source", json_integer(line->timer));
    const bool good =
        sb_connection_exchange(line, "choosing the timer", &request, &answer, err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool start(struct sb_connection *line, struct sb_caps *caps, struct sb_error *err)
{
    const struct sb_child_params params = {
        .command = line->params.worker,
        .environment = line->params.environment,
        .environment_count = line->params.environment_count,
    };
    struct sb_text ignored = {0};
    line->count++;
    if (!sb_child_start(&params, &line->child, err))
        return false;
    if (open_context(line, caps, err))
        return true;
    sb_child_end(&line->child, 5, &ignored);
    sb_text_free(&ignored);
    return false;
}

// Starts a fresh worker where there is none. It must be the same driver: else its times would
// stand beside those of another.
bool sb_connection_ensure(struct sb_connection *line, struct sb_error *err)
{
    struct sb_caps caps;
    if (!sb_connection_lost(line))
        return true;
    if (!start(line, &caps, err))
        return false;
    if (strcmp(caps.renderer, line->caps.renderer) != 0 ||
        strcmp(caps.version, line->caps.version) != 0)
        return sb_fail(err, SB_GL_ERROR,
                       "a fresh worker found another driver, %s %s instead of %s %s",
                       caps.renderer, caps.version, line->caps.renderer,
                       line->caps.version);
    sb_debug("worker %d goes on", line->count);
    return line->timer < 0 || sb_connection_tell_timer(line, err);
}

// --- from the first to the last ------------------------------------------------------------------

bool sb_connection_open(struct sb_connection *line,
                        const struct sb_context_params *params, struct sb_error *err)
{
    *line = (struct sb_connection){.params = *params, .child = {.fd = -1}, .timer = -1};
    const char **setting = sb_arena_alloc(
        &line->arena, ((size_t)params->environment_count + 1) * sizeof(char *));
    for (int i = 0; i < params->environment_count; i++)
        setting[i] = sb_arena_strdup(&line->arena, params->environment[i]);
    line->params.environment = setting;
    line->params.worker = params->worker ? sb_arena_strdup(&line->arena, params->worker)
                                         : default_command(&line->arena, err);
    line->params.count_folder = NULL;
    return line->params.worker && (!params->callgrind || count_by_callgrind(line, err)) &&
           start(line, &line->caps, err);
}

void sb_connection_renew(struct sb_connection *line)
{
    struct sb_text how = {0};
    const struct sb_frame request = {.head = sb_wire_call("close")};
    if (!sb_connection_lost(line))
        sb_frame_write(line->child.fd, &request, deadline(line));
    json_decref(request.head);
    sb_child_end(&line->child, 10, &how);
    if (strstr(sb_text_get(&how), "killed"))
        sb_warn("the worker %s when it closed; nothing is lost", how.data);
    sb_text_free(&how);
}

void sb_connection_close(struct sb_connection *line)
{
    sb_connection_renew(line);
    if (line->params.count_folder)
        sb_dir_remove(line->params.count_folder);
    sb_arena_free(&line->arena);
}
