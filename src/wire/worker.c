#include "wire/worker.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "job/callgrind.h"
#include "wire/child.h"
#include "wire/messages.h"

enum { STRIKES = 2 };

struct remote_job {
    struct remote_job *next;
    uint32_t id;
    struct sb_frame prepare; // the request, for the next worker
    int worker;              // number of the one that holds it; 0: none
    int strikes;
    struct sb_error why; // of the last strike
};

struct worker {
    struct sb_context_params params; // its texts live in `arena`
    struct sb_caps caps;
    struct sb_child child; // pid 0: none runs
    int count;             // workers started, this one included
    int timer;             // source in use; -1: none
    struct remote_job *jobs;
    struct sb_arena arena;
};

static int64_t deadline(const struct worker *worker)
{
    const double limit = worker->params.worker_limit_s;
    return sb_clock_ns() + (int64_t)((limit > 0 ? limit : 120) * 1e9);
}

// --- one worker ------------------------------------------------------------------------------

// Ends what is left of the worker, and says in *err how the exchange failed.
static bool lose(struct worker *worker, enum sb_frame_end end, const char *doing,
                 struct sb_error *err)
{
    struct sb_text how = {0};
    const struct sb_error garbage = *err;
    sb_child_end(&worker->child, end == SB_FRAME_CLOSED ? 5 : 0, &how);
    if (end == SB_FRAME_GARBAGE)
        sb_fail(err, SB_WORKER_GARBAGE, "%s: the worker %s", doing, garbage.text);
    else if (end == SB_FRAME_LATE)
        sb_fail(err, SB_WORKER_HUNG,
                "%s: the worker did not answer within %g s and was killed", doing,
                worker->params.worker_limit_s > 0 ? worker->params.worker_limit_s : 120);
    else
        sb_fail(err, SB_WORKER_CRASHED, "%s: the worker %s", doing,
                how.length ? how.data : "closed its output");
    sb_text_free(&how);
    return false;
}

static bool receive(struct worker *worker, const char *doing, struct sb_frame *answer,
                    struct sb_error *err)
{
    const enum sb_frame_end end =
        sb_frame_read(worker->child.fd, answer, deadline(worker), err);
    return end == SB_FRAME_OK || lose(worker, end, doing, err);
}

static bool send_request(struct worker *worker, const char *doing,
                         const struct sb_frame *request, struct sb_error *err)
{
    const enum sb_frame_end end =
        sb_frame_write(worker->child.fd, request, deadline(worker));
    // A worker that could not be written to has had a reason, which may be waiting.
    return end == SB_FRAME_OK || lose(worker, end, doing, err);
}

// What an answer says: false with the runner's own error; a worker that breaks the protocol is
// lost.
static bool accept_answer(struct worker *worker, const char *doing,
                          const struct sb_frame *answer, struct sb_error *err)
{
    const json_t *ok = json_object_get(answer->head, "ok");
    struct sb_error told;
    if (json_is_true(ok))
        return true;
    if (!json_is_false(ok)) {
        sb_fail(err, SB_WORKER_GARBAGE, "wrote a message that is no answer");
        return lose(worker, SB_FRAME_GARBAGE, doing, err);
    }
    if (!sb_wire_get_error(json_object_get(answer->head, "error"), &told, err))
        return lose(worker, SB_FRAME_GARBAGE, doing, err);
    *err = told;
    return false;
}

// Request and answer. *answer must be zeroed; it is filled only on success.
static bool exchange(struct worker *worker, const char *doing,
                     const struct sb_frame *request, struct sb_frame *answer,
                     struct sb_error *err)
{
    if (!send_request(worker, doing, request, err) ||
        !receive(worker, doing, answer, err))
        return false;
    if (accept_answer(worker, doing, answer, err))
        return true;
    sb_frame_free(answer);
    return false;
}

static bool lost(const struct worker *worker)
{
    return worker->child.pid == 0;
}

// A part of an answer that cannot be read: the worker is not to be believed any more.
static bool distrust(struct worker *worker, const char *doing, struct sb_error *err)
{
    return lose(worker, SB_FRAME_GARBAGE, doing, err);
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
    return sb_shell_quote(arena, beside);
}

// Sets params.worker and, to count, params.count_folder.
static bool find_command(struct worker *worker, struct sb_error *err)
{
    const char *given = worker->params.worker;
    const char *command = given ? sb_arena_strdup(&worker->arena, given)
                                : default_command(&worker->arena, err);
    worker->params.worker = command;
    worker->params.count_folder = NULL;
    if (!command)
        return false;
    if (worker->params.callgrind) {
        if (!sb_in_path("valgrind"))
            return sb_fail(err, SB_BAD_INPUT,
                           "valgrind is missing: install it to count instructions where "
                           "the kernel offers no counters");
        const char *folder = sb_temporary_dir(&worker->arena, "shadebench-count", err);
        if (!folder)
            return false;
        worker->params.count_folder = folder;
        worker->params.worker =
            sb_arena_printf(&worker->arena, "exec %s %s",
                            sb_callgrind_command(&worker->arena, folder), command);
    } else if (!given) {
        worker->params.worker = sb_arena_printf(&worker->arena, "exec %s", command);
    }
    return true;
}

static bool open_context(struct worker *worker, struct sb_caps *caps,
                         struct sb_error *err)
{
    struct sb_frame request = {.head = sb_wire_call("open")}, answer = {0};
    sb_wire_put_open(request.head, &worker->params);
    bool good = exchange(worker, "opening the context", &request, &answer, err);
    if (good && !sb_wire_get_caps(json_object_get(answer.head, "caps"), caps, err))
        good = distrust(worker, "opening the context", err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool tell_timer(struct worker *worker, struct sb_error *err)
{
    struct sb_frame request = {.head = sb_wire_call("use_timer")}, answer = {0};
    json_object_set_new(request.head, "source", json_integer(worker->timer));
    const bool good = exchange(worker, "choosing the timer", &request, &answer, err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool start(struct worker *worker, struct sb_caps *caps, struct sb_error *err)
{
    const struct sb_child_params params = {
        .command = worker->params.worker,
        .environment = worker->params.environment,
        .environment_count = worker->params.environment_count,
    };
    struct sb_text ignored = {0};
    worker->count++;
    if (!sb_child_start(&params, &worker->child, err))
        return false;
    if (open_context(worker, caps, err))
        return true;
    sb_child_end(&worker->child, 5, &ignored);
    sb_text_free(&ignored);
    return false;
}

// Starts a fresh worker where there is none. It must be the same driver: else its times would
// stand beside those of another.
static bool ensure_worker(struct worker *worker, struct sb_error *err)
{
    struct sb_caps caps;
    if (!lost(worker))
        return true;
    if (!start(worker, &caps, err))
        return false;
    if (strcmp(caps.renderer, worker->caps.renderer) != 0 ||
        strcmp(caps.version, worker->caps.version) != 0)
        return sb_fail(err, SB_GL_ERROR,
                       "a fresh worker found another driver, %s %s instead of %s %s",
                       caps.renderer, caps.version, worker->caps.renderer,
                       worker->caps.version);
    sb_debug("worker %d goes on", worker->count);
    return worker->timer < 0 || tell_timer(worker, err);
}

// --- jobs ------------------------------------------------------------------------------------

static struct remote_job *find(const struct worker *worker, uint32_t id,
                               struct sb_error *err)
{
    for (struct remote_job *job = worker->jobs; job; job = job->next)
        if (job->id == id)
            return job;
    sb_fail(err, SB_INTERNAL, "job %u is not prepared, or was released", (unsigned)id);
    return NULL;
}

static bool given_up(const struct remote_job *job, struct sb_error *err)
{
    if (job->strikes >= STRIKES && err)
        *err = job->why;
    return job->strikes >= STRIKES;
}

static void strike(struct remote_job *job, const struct sb_error *why)
{
    job->strikes++;
    job->why = *why;
    sb_warn("%s; %s", why->text,
            job->strikes < STRIKES ? "a fresh worker tries it again"
                                   : "that was the second time, so it is left out");
}

// One exchange about a job, and once more with a fresh worker where the first was lost.
static bool exchange_for(struct worker *worker, struct remote_job *job, const char *doing,
                         const struct sb_frame *request, struct sb_frame *answer,
                         struct sb_error *err)
{
    while (!given_up(job, err)) {
        if (!ensure_worker(worker, err))
            return false;
        if (exchange(worker, doing, request, answer, err))
            return true;
        if (!lost(worker))
            return false; // the runner's own word
        strike(job, err);
    }
    return false;
}

// Tells the worker of a job that an earlier one held.
static bool ensure_job(struct worker *worker, struct remote_job *job,
                       struct sb_error *err)
{
    struct sb_frame answer = {0};
    struct sb_prepared prepared = {0};
    while (!given_up(job, err)) {
        if (!ensure_worker(worker, err))
            return false;
        if (job->worker == worker->count)
            return true;
        if (!exchange_for(worker, job, "preparing it again", &job->prepare, &answer, err))
            return false;
        bool good = sb_wire_get_prepared(&answer, &prepared, err);
        sb_frame_free(&answer);
        free(prepared.log);
        if (good && prepared.error.status != SB_OK) {
            *err = prepared.error;
            return false;
        }
        if (good)
            job->worker = worker->count;
        else
            distrust(worker, "preparing it again", err);
    }
    return false;
}

static bool worker_prepare(void *self, const struct sb_job *request,
                           struct sb_prepared *prepared)
{
    struct worker *worker = self;
    struct sb_frame answer = {0};
    struct sb_error err = {0};
    struct remote_job *job = sb_alloc(sizeof *job);
    *prepared = (struct sb_prepared){0};
    job->id = request->id;
    sb_wire_put_job(request, &job->prepare);
    bool good =
        exchange_for(worker, job, "preparing a variant", &job->prepare, &answer, &err);
    if (good && !sb_wire_get_prepared(&answer, prepared, &err))
        good = distrust(worker, "preparing a variant", &err);
    if (!good)
        prepared->error = err;
    good = good && json_is_true(json_object_get(answer.head, "loaded"));
    sb_frame_free(&answer);
    if (!good) {
        sb_frame_free(&job->prepare);
        free(job);
        return false;
    }
    job->worker = worker->count;
    job->next = worker->jobs;
    worker->jobs = job;
    return true;
}

static void worker_release(void *self, uint32_t id)
{
    struct worker *worker = self;
    struct sb_error ignored = {0};
    for (struct remote_job **at = &worker->jobs; *at; at = &(*at)->next) {
        struct remote_job *job = *at;
        if (job->id != id)
            continue;
        struct sb_frame request = {.head = sb_wire_call("release")}, answer = {0};
        json_object_set_new(request.head, "id", json_integer(id));
        if (!lost(worker) && job->worker == worker->count)
            exchange(worker, "releasing a variant", &request, &answer, &ignored);
        sb_frame_free(&request);
        sb_frame_free(&answer);
        *at = job->next;
        sb_frame_free(&job->prepare);
        free(job);
        return;
    }
}

static int worker_workers(const void *self)
{
    return ((const struct worker *)self)->count;
}

static bool worker_holds(void *self, uint32_t id, struct sb_error *err)
{
    const struct remote_job *job = find(self, id, err);
    return job && !given_up(job, err);
}

// --- rounds ----------------------------------------------------------------------------------

// Shots in order, until one fails. *done: samples that came. True: all of them.
static bool shoot(struct worker *worker, const struct sb_shot *shots, int count,
                  struct sb_sample *samples, int *done, struct sb_error *err)
{
    static const char doing[] = "measuring";
    struct sb_frame request = {.head = sb_wire_call("round")};
    json_object_set_new(request.head, "shots", sb_wire_pack_shots(shots, count));
    bool good = send_request(worker, doing, &request, err);
    sb_frame_free(&request);
    for (*done = 0; good;) {
        struct sb_frame answer = {0};
        if (!receive(worker, doing, &answer, err))
            return false;
        const json_t *sample = json_object_get(answer.head, "sample");
        if (!sample) {
            good = accept_answer(worker, doing, &answer, err);
            sb_frame_free(&answer);
            if (good && *done < count) {
                sb_fail(err, SB_WORKER_GARBAGE, "has left out samples");
                good = distrust(worker, doing, err);
            }
            return good;
        }
        good = *done < count && sb_wire_get_sample(sample, &samples[*done], err);
        if (!good) {
            if (*done >= count)
                sb_fail(err, SB_WORKER_GARBAGE, "wrote more samples than were asked for");
            distrust(worker, doing, err);
        }
        *done += good;
        sb_frame_free(&answer);
    }
    return false;
}

// The jobs of a round, held by the worker that is to run it. The worker that holds the last may be
// another than the one that held the first: then all over again. A job that is given up on the
// way is left out.
static bool ensure_jobs(struct worker *worker, const struct sb_shot *shots, int count,
                        struct sb_error *err)
{
    for (int before = -1; before != worker->count;) {
        before = worker->count;
        for (int i = 0; i < count; i++) {
            struct remote_job *job = find(worker, shots[i].job, err);
            if (!job || (!given_up(job, NULL) && !ensure_job(worker, job, err) &&
                         !given_up(job, NULL)))
                return false;
        }
    }
    return true;
}

static void lose_round(const struct sb_shot *shots, int count, struct sb_sample *samples)
{
    for (int i = 0; i < count; i++)
        samples[i] = (struct sb_sample){
            .job = shots[i].job,
            .frames = shots[i].frames,
            .gpu_ns = SB_NO_TIME,
            .instructions = SB_NO_TIME,
            .flags = SB_SAMPLE_LOST,
        };
}

static bool worker_round(void *self, const struct sb_shot *shots, int count,
                         struct sb_sample *samples, struct sb_error *err)
{
    struct worker *worker = self;
    int kept = 0, done = 0;
    lose_round(shots, count, samples);
    if (!ensure_jobs(worker, shots, count, err))
        return false;
    struct sb_shot *left = sb_alloc(((size_t)count + 1) * sizeof *left);
    struct sb_sample *got = sb_alloc(((size_t)count + 1) * sizeof *got);
    for (int i = 0; i < count; i++)
        if (!given_up(find(worker, shots[i].job, NULL), NULL))
            left[kept++] = shots[i];
    bool good = kept == 0 || shoot(worker, left, kept, got, &done, err);
    if (good) {
        for (int i = 0, next = 0; i < count; i++)
            if (next < kept && left[next].job == shots[i].job)
                samples[i] = got[next++];
    } else if (lost(worker)) {
        strike(find(worker, left[done < kept ? done : kept - 1].job, NULL), err);
        good = true; // the round is lost, and its samples say so
    }
    free(left);
    free(got);
    return good;
}

// --- the rest of the seam --------------------------------------------------------------------

static bool worker_image(void *self, const struct sb_image_request *request,
                         struct sb_image *image, struct sb_error *err)
{
    struct worker *worker = self;
    struct remote_job *job = find(worker, request->job, err);
    struct sb_frame asked = {0}, answer = {0};
    bool good = false;
    sb_wire_put_request(request, &asked);
    while (job && !good && ensure_job(worker, job, err)) {
        if (exchange(worker, "drawing a picture", &asked, &answer, err)) {
            good = sb_wire_get_image(&answer, image, err) ||
                   distrust(worker, "drawing a picture", err);
            sb_frame_free(&answer);
        }
        if (good || !lost(worker))
            break;
        strike(job, err);
    }
    sb_frame_free(&asked);
    return good;
}

static bool worker_audit(void *self, struct sb_audit *audit, struct sb_error *err)
{
    struct worker *worker = self;
    struct sb_frame request = {.head = sb_wire_call("audit")}, answer = {0};
    bool good = ensure_worker(worker, err) &&
                exchange(worker, "auditing the timers", &request, &answer, err);
    if (good && !sb_wire_get_audit(json_object_get(answer.head, "audit"), audit,
                                   &worker->arena, err))
        good = distrust(worker, "auditing the timers", err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool worker_probe(void *self, struct sb_probe *probe, struct sb_error *err)
{
    struct worker *worker = self;
    struct sb_frame request = {.head = sb_wire_call("probe")}, answer = {0};
    bool good = ensure_worker(worker, err) &&
                exchange(worker, "probing the driver", &request, &answer, err);
    if (good && !sb_wire_get_probe(json_object_get(answer.head, "probe"), probe, err))
        good = distrust(worker, "probing the driver", err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool worker_use_timer(void *self, int source, struct sb_error *err)
{
    struct worker *worker = self;
    worker->timer = source;
    return ensure_worker(worker, err) && tell_timer(worker, err);
}

static void worker_close(void *self)
{
    struct worker *worker = self;
    struct sb_text how = {0};
    const struct sb_frame request = {.head = sb_wire_call("close")};
    while (worker->jobs) {
        struct remote_job *job = worker->jobs;
        worker->jobs = job->next;
        sb_frame_free(&job->prepare);
        free(job);
    }
    if (!lost(worker))
        sb_frame_write(worker->child.fd, &request, deadline(worker));
    json_decref(request.head);
    sb_child_end(&worker->child, 10, &how);
    if (strstr(sb_text_get(&how), "killed"))
        sb_warn("the worker %s when it closed; nothing is lost", how.data);
    sb_text_free(&how);
    if (worker->params.count_folder)
        sb_dir_remove(worker->params.count_folder);
    sb_arena_free(&worker->arena);
    free(worker);
}

static void *worker_open(const struct sb_context_params *params, struct sb_caps *caps,
                         struct sb_error *err)
{
    struct worker *worker = sb_alloc(sizeof *worker);
    worker->params = *params;
    worker->timer = -1;
    const char **setting = sb_arena_alloc(
        &worker->arena, ((size_t)params->environment_count + 1) * sizeof *setting);
    for (int i = 0; i < params->environment_count; i++)
        setting[i] = sb_arena_strdup(&worker->arena, params->environment[i]);
    worker->params.environment = setting;
    if (!find_command(worker, err) || !start(worker, &worker->caps, err)) {
        worker_close(worker);
        return NULL;
    }
    *caps = worker->caps;
    return worker;
}

const struct sb_runner_fns sb_runner_worker = {
    .name = "worker",
    .help = "draws in a process of its own",
    .open = worker_open,
    .audit = worker_audit,
    .use_timer = worker_use_timer,
    .probe = worker_probe,
    .prepare = worker_prepare,
    .round = worker_round,
    .image = worker_image,
    .release = worker_release,
    .holds = worker_holds,
    .workers = worker_workers,
    .close = worker_close,
};
