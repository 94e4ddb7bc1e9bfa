#include "wire/worker.h"

#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "wire/connection.h"
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
    struct sb_connection line;
    struct remote_job *jobs;
};

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
        if (!sb_connection_ensure(&worker->line, err))
            return false;
        if (sb_connection_exchange(&worker->line, doing, request, answer, err))
            return true;
        if (!sb_connection_lost(&worker->line))
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
        if (!sb_connection_ensure(&worker->line, err))
            return false;
        if (job->worker == worker->line.count)
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
            job->worker = worker->line.count;
        else
            sb_connection_distrust(&worker->line, "preparing it again", err);
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
        good = sb_connection_distrust(&worker->line, "preparing a variant", &err);
    if (!good)
        prepared->error = err;
    good = good && json_is_true(json_object_get(answer.head, "loaded"));
    sb_frame_free(&answer);
    if (!good) {
        sb_frame_free(&job->prepare);
        free(job);
        return false;
    }
    job->worker = worker->line.count;
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
        if (!sb_connection_lost(&worker->line) && job->worker == worker->line.count)
            sb_connection_exchange(&worker->line, "releasing a variant", &request,
                                   &answer, &ignored);
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
    return ((const struct worker *)self)->line.count;
}

static void worker_renew(void *self)
{
    sb_connection_renew(&((struct worker *)self)->line);
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
    bool good = sb_connection_send(&worker->line, doing, &request, err);
    sb_frame_free(&request);
    for (*done = 0; good;) {
        struct sb_frame answer = {0};
        if (!sb_connection_receive(&worker->line, doing, &answer, err))
            return false;
        const json_t *sample = json_object_get(answer.head, "sample");
        if (!sample) {
            good = sb_connection_accept(&worker->line, doing, &answer, err);
            sb_frame_free(&answer);
            if (good && *done < count) {
                sb_fail(err, SB_WORKER_GARBAGE, "has left out samples");
                good = sb_connection_distrust(&worker->line, doing, err);
            }
            return good;
        }
        good = *done < count && sb_wire_get_sample(sample, &samples[*done], err);
        if (!good) {
            if (*done >= count)
                sb_fail(err, SB_WORKER_GARBAGE, "wrote more samples than were asked for");
            sb_connection_distrust(&worker->line, doing, err);
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
    for (int before = -1; before != worker->line.count;) {
        before = worker->line.count;
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
    } else if (sb_connection_lost(&worker->line)) {
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
        if (sb_connection_exchange(&worker->line, "drawing a picture", &asked, &answer,
                                   err)) {
            good = sb_wire_get_image(&answer, image, err) ||
                   sb_connection_distrust(&worker->line, "drawing a picture", err);
            sb_frame_free(&answer);
        }
        if (good || !sb_connection_lost(&worker->line))
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
    bool good = sb_connection_ensure(&worker->line, err) &&
                sb_connection_exchange(&worker->line, "auditing the timers", &request,
                                       &answer, err);
    if (good && !sb_wire_get_audit(json_object_get(answer.head, "audit"), audit,
                                   &worker->line.arena, err))
        good = sb_connection_distrust(&worker->line, "auditing the timers", err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool worker_probe(void *self, struct sb_probe *probe, struct sb_error *err)
{
    struct worker *worker = self;
    struct sb_frame request = {.head = sb_wire_call("probe")}, answer = {0};
    bool good = sb_connection_ensure(&worker->line, err) &&
                sb_connection_exchange(&worker->line, "probing the driver", &request,
                                       &answer, err);
    if (good && !sb_wire_get_probe(json_object_get(answer.head, "probe"), probe, err))
        good = sb_connection_distrust(&worker->line, "probing the driver", err);
    sb_frame_free(&request);
    sb_frame_free(&answer);
    return good;
}

static bool worker_use_timer(void *self, int source, struct sb_error *err)
{
    struct worker *worker = self;
    worker->line.timer = source;
    return sb_connection_ensure(&worker->line, err) &&
           sb_connection_tell_timer(&worker->line, err);
}

static void worker_close(void *self)
{
    struct worker *worker = self;
    while (worker->jobs) {
        struct remote_job *job = worker->jobs;
        worker->jobs = job->next;
        sb_frame_free(&job->prepare);
        free(job);
    }
    sb_connection_close(&worker->line);
    free(worker);
}

static void *worker_open(const struct sb_context_params *params, struct sb_caps *caps,
                         struct sb_error *err)
{
    struct worker *worker = sb_alloc(sizeof *worker);
    if (!sb_connection_open(&worker->line, params, err)) {
        worker_close(worker);
        return NULL;
    }
    *caps = worker->line.caps;
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
    .renew = worker_renew,
    .close = worker_close,
};
