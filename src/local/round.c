// Timed batches. Everything that can be made, looked up or refused is, before the first
// clock is read.
#include "local/state.h"

#include <inttypes.h>

#include "base/clock.h"

static void read_timer(struct sb_local *local, struct sb_sample *sample)
{
    sample->gpu_ns = SB_NO_TIME;
    if (!local->timer)
        return;
    int64_t ns = SB_NO_TIME;
    switch (sb_timer_read(local->timer, &local->query, &local->caps, &ns)) {
    case SB_READ_LATER:
        sample->flags |= SB_SAMPLE_LOST;
        return;
    case SB_READ_DISJOINT:
        sample->flags |= SB_SAMPLE_DISJOINT;
        break;
    case SB_READ_OK:
        // The first query of a context was seen to return 10^12 ns.
        if (ns != SB_NO_TIME && (ns < 0 || ns > 10 * sample->wall_ns + 1000000000))
            sample->flags |= SB_SAMPLE_ABSURD;
        break;
    }
    sample->gpu_ns = ns;
}

struct sb_frame_params sb_local_frame(const struct sb_local *local,
                                      const struct sb_local_job *job)
{
    return (struct sb_frame_params){
        .binding = job->lit.binding,
        .binding_count = job->lit.binding_count,
        .lamp = job->lamp.program ? &job->lamp : NULL,
        .shadow = job->shadow.casters > 0 ? &job->shadow : NULL,
        .unused_shadow = job->unused_shadow.casters > 0 ? &job->unused_shadow : NULL,
        .layers = job->shape.layers,
        .phase = -1,
        .gles = local->caps.gles,
    };
}

void sb_local_batch(struct sb_local *local, const struct sb_local_job *job,
                    const struct sb_ring *ring, const struct sb_shot *shot,
                    struct sb_counter *counter, struct sb_sample *sample, int64_t *calls)
{
    struct sb_frame_params frame = sb_local_frame(local, job);
    frame.shadows_only = shot->part == SB_PART_SHADOWS;
    const bool moves = job->lit.binding->phase_count > 1;
    int64_t frame_calls = 0;
    const int64_t cpu_begin = sb_cpu_ns();
    const int64_t begin = sb_clock_ns();
    if (counter)
        counter->fns->start(counter);
    if (local->timer)
        local->timer->begin(&local->query);
    for (int i = 0; i < shot->frames; i++) {
        frame.target = &ring->target[i % SB_RING_SIZE];
        if (moves)
            frame.phase = i % job->lit.binding->phase_count;
        frame_calls = sb_frame_draw(&frame);
    }
    if (local->timer)
        local->timer->end(&local->query);
    if (frame.shadows_only)
        sb_frame_end_shadows(frame.target);
    const int64_t submitted = sb_clock_ns();
    sb_gl_drain();
    if (counter)
        counter->fns->stop(counter);
    const int64_t drained = sb_clock_ns();
    *sample = (struct sb_sample){
        .job = job->id,
        .frames = shot->frames,
        .wall_ns = drained - begin,
        .cpu_ns = sb_cpu_ns() - cpu_begin,
        .submit_ns = submitted - begin,
        .instructions = SB_NO_TIME,
    };
    read_timer(local, sample);
    if (calls)
        *calls = frame_calls;
}

// A counted batch comes after a frame of its own job that is not: to change from one program to
// another is no part of a frame.
static void draw_before_counting(struct sb_local *local, const struct sb_local_job *job,
                                 const struct sb_ring *ring, const struct sb_shot *shot)
{
    struct sb_sample ignored;
    struct sb_shot one = *shot;
    one.frames = 1;
    sb_local_batch(local, job, ring, &one, NULL, &ignored, NULL);
}

static bool makes_sense(const struct sb_local_job *job, const struct sb_shot *shot,
                        struct sb_error *err)
{
    if (shot->frames < 1 || shot->shrink < 1 || shot->shrink > 2)
        return sb_fail(err, SB_INTERNAL,
                       "job %" PRIu32 ": %d frames, shrink %d; valid: at least 1 frame, "
                       "shrink 1 or 2",
                       shot->job, shot->frames, shot->shrink);
    if (shot->part != SB_PART_WHOLE && job->shadow.phase_count <= 1)
        return sb_fail(err, SB_INTERNAL,
                       "job %" PRIu32 ": part %d of a frame; this job's frames draw no "
                       "shadow maps, so valid is the whole",
                       shot->job, (int)shot->part);
    return true;
}

// The targets that a shot draws into.
static const struct sb_ring *ring_of(struct sb_local *local, const struct sb_shot *shot,
                                     struct sb_error *err)
{
    struct sb_local_job *job = sb_local_job_find(local, shot->job, err);
    if (!job || !makes_sense(job, shot, err))
        return NULL;
    if (shot->shrink == 1)
        return &job->ring->ring;
    if (!job->half) {
        struct sb_shape shape = job->shape;
        shape.width = (shape.width + 1) / 2;
        shape.height = (shape.height + 1) / 2;
        job->half = sb_pool_ring_get(&local->pool, &local->caps, &shape, err);
    }
    return job->half ? &job->half->ring : NULL;
}

bool sb_local_round(void *self, const struct sb_shot *shots, int count,
                    struct sb_sample *samples, struct sb_error *err)
{
    struct sb_local *local = self;
    struct sb_counter *counter = local->counter.fns ? &local->counter : NULL;
    for (int i = 0; i < count; i++) {
        if (!ring_of(local, &shots[i], err))
            return false;
    }
    for (int i = 0; i < count; i++) {
        const struct sb_local_job *job = sb_local_job_find(local, shots[i].job, err);
        const struct sb_ring *ring = ring_of(local, &shots[i], err);
        if (counter)
            draw_before_counting(local, job, ring, &shots[i]);
        sb_local_batch(local, job, ring, &shots[i], counter, &samples[i], NULL);
        if (counter && !counter->fns->read(counter, &samples[i].instructions, err))
            return false;
        if (!sb_local_gl_ok("measuring", shots[i].job, err))
            return false;
    }
    return true;
}
