// gate.json: everything needed to repeat a gate, and to judge its verdicts.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/file.h"
#include "gate/state.h"
#include "measure/machine.h"
#include "measure/record.h"
#include "stats/counts.h"

static json_t *side_json(const struct sb_gate_state *gate, int side)
{
    const struct sb_gate_side_params *params = &gate->params.side[side];
    const struct sb_context_params *context = &params->driver.context;
    json_t *object = json_object(), *environment = json_array();
    for (int i = 0; i < context->environment_count; i++)
        json_array_append_new(environment, json_string(context->environment[i]));
    json_object_set_new(object, "shaders",
                        params->shaders ? json_string(params->shaders) : json_null());
    json_object_set_new(object, "environment", environment);
    json_object_set_new(object, "caps", sb_caps_json(&gate->session.driver[side].caps));
    return object;
}

static json_t *rule_json(const struct sb_gate_rule *rule)
{
    json_t *object = json_object();
    json_object_set_new(object, "tolerance", json_real(rule->tolerance));
    json_object_set_new(object, "alpha", json_real(rule->alpha));
    json_object_set_new(object, "variants", json_integer(rule->variants));
    json_object_set_new(object, "first_look", json_integer(rule->looks.first));
    json_object_set_new(object, "pairs", json_integer(rule->looks.rounds));
    json_object_set_new(object, "confirm_pairs", json_integer(rule->confirm_pairs));
    return object;
}

static json_t *counting_json(const struct sb_gate_counting *counting)
{
    json_t *object = json_object(), *environment = json_array();
    const double repeatability = counting->repeatability;
    for (int i = 0; i < SB_COUNTS_ENVIRONMENT; i++)
        json_array_append_new(environment, json_string(sb_counts_environment[i]));
    json_object_set_new(object, "speaks_of",
                        json_string("this CPU driver, not of any GPU"));
    json_object_set_new(object, "environment", environment);
    json_object_set_new(object, "repeats", json_integer(SB_COUNTS_REPEATS));
    json_object_set_new(object, "repeatability",
                        isfinite(repeatability) ? json_real(repeatability) : json_null());
    json_object_set_new(object, "counts", json_integer(counting->counts));
    json_object_set_new(object, "apart", json_integer(counting->apart));
    json_object_set_new(object, "farthest", json_real(counting->farthest));
    json_object_set_new(object, "other_code", json_string(counting->other_code));
    for (int side = 0; side < SB_SIDES; side++)
        json_object_set_new(object, side == SB_BASE ? "base_caps" : "head_caps",
                            sb_caps_json(&counting->caps[side]));
    return object;
}

static json_t *make(const struct sb_gate_state *gate, const struct sb_gate_result *result,
                    bool complete)
{
    const struct sb_gate_params *params = &gate->params;
    char now[32];
    json_t *object = json_object();
    sb_timestamp(now);
    json_object_set_new(object, "shadebench", json_string(SB_VERSION));
    json_object_set_new(object, "complete", json_boolean(complete));
    json_object_set_new(object, "started", json_string(gate->started));
    json_object_set_new(object, "ended", complete ? json_string(now) : json_null());
    json_object_set_new(object, "arguments", json_deep_copy(params->arguments));
    json_object_set_new(object, "suite", json_string(params->side[SB_HEAD].suite->name));
    json_object_set_new(object, "base", side_json(gate, SB_BASE));
    json_object_set_new(object, "head", side_json(gate, SB_HEAD));
    json_object_set_new(object, "apart", json_boolean(params->apart));
    json_object_set_new(object, "selftest", json_boolean(params->selftest));
    json_object_set_new(object, "metric",
                        json_string(sb_metric_rows[result->metric].name));
    json_object_set_new(object, "timer_source", json_string(result->timer));
    json_object_set_new(object, "rule", rule_json(&result->rule));
    json_object_set_new(object, "seed", json_integer((json_int_t)params->settings->seed));
    json_object_set_new(object, "budget", json_real(params->settings->budget));
    if (result->metric == SB_METRIC_GPU)
        for (int side = 0; side < (params->apart ? SB_SIDES : 1); side++)
            json_object_set_new(object, side == SB_BASE ? "timers" : "head_timers",
                                sb_audit_json(&gate->session.driver[side]));
    if (result->metric == SB_METRIC_INSTRUCTIONS)
        json_object_set_new(object, "counting", counting_json(&result->counting));
    json_object_set_new(object, "machine", sb_machine_json());
    json_object_set_new(object, "environment", sb_environment_json());
    if (complete)
        json_object_set_new(object, "exit_code", json_integer(result->exit_code));
    return object;
}

bool sb_gate_record(const struct sb_gate_state *gate, const struct sb_gate_result *result,
                    bool complete, struct sb_error *err)
{
    struct sb_arena arena = {0};
    json_t *object = make(gate, result, complete);
    char *text = json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    json_decref(object);
    const bool good =
        text ? sb_file_replace(sb_path_join(&arena, gate->params.dir, "gate.json"), text,
                               strlen(text), err)
             : sb_fail(err, SB_INTERNAL, "gate.json cannot be put together");
    free(text);
    sb_arena_free(&arena);
    return good;
}
