#include "wire/serve.h"

#include <stdlib.h>
#include <string.h>

#include "wire/messages.h"

struct held_job { // what the runner may look at until the job is released
    struct held_job *next;
    uint32_t id;
    struct sb_arena arena;
};

struct server {
    const struct sb_serve_params *params;
    const struct sb_runner_fns *fns;
    void *runner; // NULL: not open yet
    struct held_job *jobs;
    struct sb_arena arena;
};

// A failed call fills *err; what a request got wrong does, too.
typedef bool (*handler)(struct server *server, const struct sb_frame *request,
                        struct sb_frame *answer, struct sb_error *err);

static bool handle_open(struct server *server, const struct sb_frame *request,
                        struct sb_frame *answer, struct sb_error *err)
{
    struct sb_context_params params = {0};
    struct sb_caps caps;
    if (server->runner)
        return sb_fail(err, SB_INTERNAL, "the worker is open already");
    if (!sb_wire_get_open(request->head, &params, &server->arena, err) ||
        !(server->fns = server->params->runner(&params, err)) ||
        !(server->runner = server->fns->open(&params, &caps, err)))
        return false;
    json_object_set_new(answer->head, "caps", sb_wire_pack_caps(&caps));
    return true;
}

static bool handle_audit(struct server *server, const struct sb_frame *request,
                         struct sb_frame *answer, struct sb_error *err)
{
    (void)request;
    struct sb_audit *audit = sb_alloc(sizeof *audit);
    const bool good = server->fns->audit(server->runner, audit, err);
    if (good)
        json_object_set_new(answer->head, "audit", sb_wire_pack_audit(audit));
    free(audit);
    return good;
}

static bool handle_use_timer(struct server *server, const struct sb_frame *request,
                             struct sb_frame *answer, struct sb_error *err)
{
    (void)answer;
    const json_t *source = json_object_get(request->head, "source");
    return server->fns->use_timer(server->runner, (int)json_integer_value(source), err);
}

static bool handle_probe(struct server *server, const struct sb_frame *request,
                         struct sb_frame *answer, struct sb_error *err)
{
    (void)request;
    struct sb_probe probe;
    if (!server->fns->probe(server->runner, &probe, err))
        return false;
    json_object_set_new(answer->head, "probe", sb_wire_pack_probe(&probe));
    return true;
}

static void drop_job(struct server *server, uint32_t id)
{
    for (struct held_job **at = &server->jobs; *at; at = &(*at)->next) {
        struct held_job *job = *at;
        if (job->id != id)
            continue;
        *at = job->next;
        sb_arena_free(&job->arena);
        free(job);
        return;
    }
}

// That the driver refuses a job is an answer, not a failure of the call.
static bool handle_prepare(struct server *server, const struct sb_frame *request,
                           struct sb_frame *answer, struct sb_error *err)
{
    struct held_job *held = sb_alloc(sizeof *held);
    struct sb_job job;
    struct sb_prepared prepared = {0};
    if (!sb_wire_get_job(request, &job, &held->arena, err)) {
        sb_arena_free(&held->arena);
        free(held);
        return false;
    }
    held->id = job.id;
    held->next = server->jobs;
    server->jobs = held;
    const bool good = server->fns->prepare(server->runner, &job, &prepared);
    json_object_set_new(answer->head, "loaded", json_boolean(good));
    sb_wire_put_prepared(&prepared, answer);
    free(prepared.log);
    if (!good)
        drop_job(server, job.id);
    return true;
}

static bool send_sample(const struct server *server, const struct sb_sample *sample,
                        struct sb_error *err)
{
    struct sb_frame frame = {.head = json_object()};
    json_object_set_new(frame.head, "sample", sb_wire_pack_sample(sample));
    const bool sent =
        sb_frame_write(server->params->out, &frame, SB_NO_DEADLINE) == SB_FRAME_OK;
    sb_frame_free(&frame);
    return sent || sb_fail(err, SB_INTERRUPTED, "nobody reads the samples");
}

// Each sample is sent as soon as it is there: should the driver end this process, the other side
// knows with which batch.
static bool handle_round(struct server *server, const struct sb_frame *request,
                         struct sb_frame *answer, struct sb_error *err)
{
    (void)answer;
    const json_t *list = json_object_get(request->head, "shots");
    const size_t room = json_array_size(list);
    struct sb_shot *shot = sb_alloc((room + 1) * sizeof *shot);
    int count = 0;
    bool good = sb_wire_get_shots(list, shot, (int)room, &count, err);
    for (int i = 0; good && i < count; i++) {
        struct sb_sample sample = {0};
        good = server->fns->round(server->runner, &shot[i], 1, &sample, err) &&
               send_sample(server, &sample, err);
    }
    free(shot);
    return good;
}

static bool handle_image(struct server *server, const struct sb_frame *request,
                         struct sb_frame *answer, struct sb_error *err)
{
    struct sb_image_request asked;
    struct sb_image rows = {0}, image = {0};
    const bool good = sb_wire_get_request(request, &asked, &rows, err) &&
                      server->fns->image(server->runner, &asked, &image, err);
    if (good)
        sb_wire_put_image(&image, answer);
    sb_image_free(&rows);
    sb_image_free(&image);
    return good;
}

static bool handle_release(struct server *server, const struct sb_frame *request,
                           struct sb_frame *answer, struct sb_error *err)
{
    (void)answer, (void)err;
    const uint32_t id =
        (uint32_t)json_integer_value(json_object_get(request->head, "id"));
    server->fns->release(server->runner, id);
    drop_job(server, id);
    return true;
}

static const struct {
    const char *call;
    handler handle;
} handlers[] = {
    {"open", handle_open},   {"audit", handle_audit},     {"use_timer", handle_use_timer},
    {"probe", handle_probe}, {"prepare", handle_prepare}, {"round", handle_round},
    {"image", handle_image}, {"release", handle_release},
};

static bool handle(struct server *server, const struct sb_frame *request,
                   struct sb_frame *answer, struct sb_error *err)
{
    const char *call = json_string_value(json_object_get(request->head, "call"));
    for (size_t i = 0; call && i < sizeof handlers / sizeof *handlers; i++)
        if (strcmp(handlers[i].call, call) == 0)
            return i > 0 && !server->runner
                       ? sb_fail(err, SB_INTERNAL, "%s was asked before open", call)
                       : handlers[i].handle(server, request, answer, err);
    return sb_fail(err, SB_BAD_INPUT, "\"%s\" is no call of the worker protocol",
                   call ? call : "");
}

// False: there is nobody to answer.
static bool answer_one(struct server *server, const struct sb_frame *request)
{
    struct sb_error err = {0};
    struct sb_frame answer = {.head = json_object()};
    const bool good = handle(server, request, &answer, &err);
    json_object_set_new(answer.head, "ok", json_boolean(good));
    if (!good)
        json_object_set_new(answer.head, "error", sb_wire_pack_error(&err));
    const bool sent =
        sb_frame_write(server->params->out, &answer, SB_NO_DEADLINE) == SB_FRAME_OK;
    sb_frame_free(&answer);
    return sent;
}

static bool is_close(const struct sb_frame *request)
{
    const char *call = json_string_value(json_object_get(request->head, "call"));
    return call && strcmp(call, "close") == 0;
}

int sb_serve(const struct sb_serve_params *params)
{
    struct server server = {.params = params};
    struct sb_error err = {0};
    int code = 0;
    for (bool more = true; more;) {
        struct sb_frame request = {0};
        const enum sb_frame_end end =
            sb_frame_read(params->in, &request, SB_NO_DEADLINE, &err);
        if (end == SB_FRAME_GARBAGE)
            code = sb_status_rows[SB_BAD_INPUT].exit_code;
        const bool closing = end == SB_FRAME_OK && is_close(&request);
        if (closing && params->closing)
            atomic_store(params->closing, true);
        more = end == SB_FRAME_OK && !closing;
        if (more && !answer_one(&server, &request)) {
            code = sb_status_rows[SB_WRITE_FAILED].exit_code;
            more = false;
        }
        sb_frame_free(&request);
    }
    if (server.runner)
        server.fns->close(server.runner);
    while (server.jobs)
        drop_job(&server, server.jobs->id);
    sb_arena_free(&server.arena);
    return code;
}
