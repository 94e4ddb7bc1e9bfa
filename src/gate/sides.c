// The two sides: their drivers and their programs.
#include <stdlib.h>

#include "gate/state.h"

const char *const sb_side_names[SB_SIDES] = {"base", "head"};

// Where instructions are wanted, each process is asked for them; under callgrind all takes some 50
// times as long.
static bool connect(const struct sb_gate_session *session,
                    const struct sb_driver_params *given, struct sb_driver *driver,
                    struct sb_error *err)
{
    struct sb_driver_params params = *given;
    struct sb_context_params *context = &params.context;
    const int count = context->environment_count;
    if (session->metric != SB_METRIC_INSTRUCTIONS)
        return sb_driver_connect(given, driver, err);
    const char **setting =
        sb_alloc(((size_t)count + SB_COUNTS_ENVIRONMENT) * sizeof *setting);
    for (int i = 0; i < count; i++)
        setting[i] = context->environment[i];
    for (int i = 0; i < SB_COUNTS_ENVIRONMENT; i++)
        setting[count + i] = sb_counts_environment[i];
    context->environment = setting;
    context->environment_count += SB_COUNTS_ENVIRONMENT;
    context->count = true;
    context->callgrind = session->callgrind;
    if (session->callgrind)
        context->worker_limit_s =
            20 * (context->worker_limit_s > 0 ? context->worker_limit_s : 120);
    const bool good = sb_driver_connect(&params, driver, err);
    free(setting);
    return good;
}

static bool open_side(struct sb_gate_session *session, enum sb_side side,
                      struct sb_error *err)
{
    const struct sb_gate_params *params = session->params;
    struct sb_driver *driver = &session->driver[side];
    if (side == SB_HEAD && !params->apart) {
        *driver = session->driver[SB_BASE];
        return true;
    }
    if (!connect(session, &params->side[side].driver, driver, err))
        return false;
    session->open[side] = true;
    return true;
}

// CPU time is the cost of a picture where a CPU draws it, and else that of asking for it. Of one of
// each, only the clock is the same on both sides.
static bool choose_metric(struct sb_gate_session *session, struct sb_error *err)
{
    const bool cpu[SB_SIDES] = {session->driver[SB_BASE].caps.software,
                                session->driver[SB_HEAD].caps.software};
    const bool alike = cpu[SB_BASE] == cpu[SB_HEAD];
    if (session->metric == SB_METRIC_AUTO)
        session->metric = !alike         ? SB_METRIC_WALL
                          : cpu[SB_BASE] ? SB_METRIC_CPU
                                         : SB_METRIC_GPU;
    return alike || session->metric == SB_METRIC_WALL ||
           sb_fail(err, SB_BAD_INPUT,
                   "--metric %s: a CPU draws one side and a GPU the other; valid: wall",
                   sb_metric_rows[session->metric].name);
}

// Two sources may each be credible, and not alike: the sides have one, and confirmations the same.
static bool prove_timers(struct sb_gate_session *session, struct sb_error *err)
{
    if (session->metric != SB_METRIC_GPU)
        return true;
    for (int side = 0; side < SB_SIDES; side++) {
        struct sb_driver *driver = &session->driver[side];
        const char *wanted =
            session->timer ? session->timer : session->params->side[side].driver.timer;
        if (side == SB_HEAD && !session->params->apart)
            *driver = session->driver[SB_BASE];
        else if (!sb_driver_prove(driver, wanted, err))
            return false;
        session->timer = driver->audit.source[driver->timer].name;
    }
    return true;
}

bool sb_gate_session_open(struct sb_gate_session *session,
                          const struct sb_gate_params *params, struct sb_error *err)
{
    session->params = params;
    if (session->metric == SB_METRIC_AUTO) // else a confirmation: what the gate has
        session->metric = params->metric;
    return open_side(session, SB_BASE, err) && open_side(session, SB_HEAD, err) &&
           choose_metric(session, err) && prove_timers(session, err);
}

// A frozen program is prepared once, as the first pair's; the others have a copy that owns nothing.
static bool is_shared(const struct sb_gate_session *session, int place, int side)
{
    return session->params && session->params->side[side].frozen && place > 0;
}

void sb_gate_session_prepare(struct sb_gate_session *session, int place, int entry)
{
    struct sb_gate_pair *pair = &session->pair[place];
    for (int side = 0; side < SB_SIDES; side++) {
        const struct sb_gate_side_params *given = &session->params->side[side];
        if (is_shared(session, place, side)) {
            pair->task[side] = session->pair[0].task[side];
            pair->task[side].note = (struct sb_text){0};
            continue;
        }
        const struct sb_prepare_params params = {
            .suite = given->suite,
            .driver = &session->driver[side],
            .data_dir = session->params->data_dir,
            .shaders = given->shaders,
            .renamed = given->renamed,
            .frozen = given->frozen,
        };
        pair->task[side].entry = &given->suite->entry[given->frozen ? 0 : entry];
        sb_task_prepare(&pair->task[side], &params,
                        (uint32_t)(SB_SIDES * entry + side + 1));
    }
    const struct sb_task *base = &pair->task[SB_BASE], *head = &pair->task[SB_HEAD];
    // In two environments, equal texts are two programs.
    const bool equal = base->loaded && head->loaded && !session->params->apart &&
                       base->assembly.source_hash == head->assembly.source_hash &&
                       base->prepared.input_hash == head->prepared.input_hash &&
                       sb_variant_equal(&session->params->side[SB_BASE].suite->axes,
                                        &base->entry->variant, &head->entry->variant);
    pair->timed = !equal || session->params->keep_equal;
}

void sb_gate_session_close(struct sb_gate_session *session)
{
    for (int i = 0; i < session->pair_count; i++)
        for (int side = 0; side < SB_SIDES; side++) {
            if (!is_shared(session, i, side))
                sb_task_free(&session->pair[i].task[side], &session->driver[side]);
            free(session->pair[i].value[side]);
        }
    for (int i = 0; i < session->pair_count; i++)
        free(session->pair[i].process);
    free(session->pair);
    for (int side = 0; side < SB_SIDES; side++)
        if (session->open[side])
            sb_driver_close(&session->driver[side]);
    *session = (struct sb_gate_session){0};
}
