// The table of the in-process runner, and what concerns the context as a whole.
#include "local/local.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/cpu.h"
#include "base/environment.h"
#include "base/mem.h"
#include "gl/audit.h"
#include "local/state.h"

static void close_runner(void *self)
{
    struct sb_local *local = self;
    while (local->jobs)
        sb_local_release(local, local->jobs->id);
    sb_query_free(&local->query);
    sb_gl_program_free(&local->id_program);
    sb_gl_program_free(&local->geometry_program);
    sb_gl_program_free(&local->blank_program);
    sb_target_free(&local->probe_target);
    sb_target_free(&local->rows_target);
    sb_gl_program_cache_close(local->cache);
    glDeleteVertexArrays(1, &local->no_vertices);
    local->context->close(local->window);
    sb_counter_close(&local->counter);
    free(local);
}

static void *open_runner(const struct sb_context_params *params, struct sb_caps *caps,
                         struct sb_error *err)
{
    const struct sb_context_options options = {.gles = params->gles,
                                               .device = params->device};
    struct sb_local *local = sb_alloc(sizeof *local);
    sb_environment_apply(params->environment, params->environment_count);
    if (params->count)
        sb_counter_open(&local->counter, params->count_folder);
    local->window = sb_context_open(params->context, &options, &local->context, err);
    if (!local->window)
        goto no_context;
    if (!sb_gl_load(local->context->proc, local->window, params->gles, &local->caps, err))
        goto no_entry_points;
    snprintf(local->caps.context, sizeof local->caps.context, "%s", local->context->name);
    sb_cpu_name(local->caps.cpu, sizeof local->caps.cpu);
    sb_cpu_features(local->caps.cpu_features, sizeof local->caps.cpu_features);
    if (local->counter.fns)
        snprintf(local->caps.counter, sizeof local->caps.counter, "%s",
                 local->counter.fns->name);
    local->caps.software =
        local->context->software && local->context->software(local->window);
    if (!sb_id_program_make(&local->id_program, local->caps.gles, err)) {
        close_runner(local);
        return NULL;
    }
    local->driver_stats = params->driver_stats;
    if (params->program_cache)
        local->cache = sb_gl_program_cache_open(params->program_cache, &local->caps);
    *caps = local->caps;
    return local;

no_entry_points:
    local->context->close(local->window);
no_context:
    sb_counter_close(&local->counter);
    free(local);
    return NULL;
}

static bool audit(void *self, struct sb_audit *readings, struct sb_error *err)
{
    const struct sb_local *local = self;
    return sb_gl_audit_read(&local->caps, readings, err);
}

static bool probe(void *self, struct sb_probe *readings, struct sb_error *err)
{
    const struct sb_local *local = self;
    return sb_gl_probe_precision(&local->caps, readings, err) &&
           sb_gl_probe_nesting(&local->caps, &readings->nesting, err);
}

static bool use_timer(void *self, int source, struct sb_error *err)
{
    struct sb_local *local = self;
    int count = 0;
    while (sb_timers[count])
        count++;
    if (source < 0 || source >= count)
        return sb_fail(err, SB_INTERNAL, "timer source %d; valid: 0 to %d", source,
                       count - 1);
    if (!sb_timers[source]->usable(&local->caps))
        return sb_fail(err, SB_NO_TIMER, "timer source %s: this context cannot use it",
                       sb_timers[source]->name);
    // A query object serves one source.
    sb_query_free(&local->query);
    sb_query_make(&local->query);
    local->timer = sb_timers[source];
    return true;
}

const struct sb_runner_fns sb_runner_local = {
    .name = "local",
    .help = "draws in this process",
    .open = open_runner,
    .audit = audit,
    .use_timer = use_timer,
    .probe = probe,
    .prepare = sb_local_prepare,
    .round = sb_local_round,
    .image = sb_local_image,
    .release = sb_local_release,
    .close = close_runner,
};
