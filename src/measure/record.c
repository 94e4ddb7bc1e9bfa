#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "job/caps.h"
#include "measure/machine.h"
#include "measure/record.h"

json_t *sb_caps_json(const struct sb_caps *caps)
{
    json_t *object = json_object();
    json_object_set_new(object, "context", json_string(caps->context));
    for (int i = 0; i < sb_caps_row_count; i++) {
        const void *field = (const char *)caps + sb_caps_rows[i].offset;
        json_object_set_new(object, sb_caps_rows[i].name,
                            sb_caps_rows[i].text ? json_string(field)
                                                 : json_integer(*(const int64_t *)field));
    }
    return object;
}

json_t *sb_audit_json(const struct sb_driver *driver)
{
    json_t *list = json_array();
    for (int i = 0; i < driver->audit.source_count; i++) {
        const struct sb_timer_source *source = &driver->audit.source[i];
        json_t *object = json_object();
        json_object_set_new(object, "timer", json_string(source->name));
        json_object_set_new(object, "usable", json_boolean(source->usable));
        json_object_set_new(object, "chosen", json_boolean(i == driver->timer));
        json_object_set_new(object, "credible", json_boolean(source->credible));
        json_object_set_new(object, "error",
                            isfinite(source->error) ? json_real(source->error)
                                                    : json_null());
        json_object_set_new(object, "bits", json_integer(source->bits));
        json_object_set_new(object, "granularity_ns", json_real(source->granularity_ns));
        json_object_set_new(object, "empty_ns", json_real(source->empty_ns));
        json_object_set_new(object, "reason", json_string(source->reason));
        json_array_append_new(list, object);
    }
    return list;
}

// JSON has neither infinities nor NaN.
static json_t *number_json(float x)
{
    return isfinite(x) ? json_real(x)
           : isnan(x)  ? json_string("nan")
           : x > 0     ? json_string("inf")
                       : json_string("-inf");
}

static json_t *reading_json(const struct sb_precision_reading *reading)
{
    json_t *object = json_object();
    const bool chain = reading->carrier == SB_CARRIER_ARITHMETIC;
    json_object_set_new(object, "add", number_json(reading->add));
    json_object_set_new(object, "square", number_json(reading->square));
    json_object_set_new(object, "tiny", number_json(reading->tiny));
    json_object_set_new(object, "round", number_json(reading->round));
    if (chain) {
        json_object_set_new(object, "lone", number_json(reading->lone));
        json_object_set_new(object, "nan_left", number_json(reading->nan_left));
        json_object_set_new(object, "nan_right", number_json(reading->nan_right));
        json_object_set_new(object, "pow_zero", number_json(reading->pow_zero));
    } else if (!isnan(reading->used)) {
        json_object_set_new(object, "used", number_json(reading->used));
    }
    return object;
}

json_t *sb_precision_json(const struct sb_driver *driver)
{
    json_t *list = json_array();
    for (int i = 0; i < driver->probe.count; i++) {
        const struct sb_precision_reading *reading = &driver->probe.reading[i];
        const struct sb_precision_verdict *verdict = &driver->verdict[i];
        json_t *object = json_object();
        json_object_set_new(object, "stage",
                            json_string(reading->vertex_stage ? "vertex" : "fragment"));
        json_object_set_new(object, "carrier",
                            json_string(sb_carriers[reading->carrier].name));
        json_object_set_new(object, "precision",
                            json_string(sb_precision_names[reading->precision]));
        json_object_set_new(object, "effective",
                            json_string(sb_effective_names[verdict->effective]));
        json_object_set_new(object, "verdict", json_string(verdict->text));
        json_object_set_new(object, "reading", reading_json(reading));
        json_array_append_new(list, object);
    }
    return list;
}

json_t *sb_settings_json(const struct sb_measure_settings *settings)
{
    json_t *object = json_object();
    for (int i = 0; i < sb_measure_row_count; i++)
        json_object_set_new(object, sb_measure_rows[i].name,
                            json_real(*(const double *)((const char *)settings +
                                                        sb_measure_rows[i].offset)));
    return object;
}

static json_t *entries_json(const struct sb_record_params *params)
{
    json_t *list = json_array();
    for (int i = 0; i < params->task_count; i++) {
        const struct sb_task *task = &params->task[i];
        json_t *object = json_object();
        json_object_set_new(object, "scene", json_string(task->entry->scene));
        json_object_set_new(object, "variant", json_string(task->entry->id));
        json_object_set_new(object, "batch", json_integer(task->batch));
        json_object_set_new(
            object, "source_hash",
            json_sprintf("%016llx", (unsigned long long)task->assembly.source_hash));
        json_object_set_new(
            object, "input_hash",
            json_sprintf("%016llx", (unsigned long long)task->prepared.input_hash));
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *processes_json(const struct sb_record_params *params,
                              const json_t *earlier)
{
    json_t *list = json_deep_copy(json_object_get(earlier, "processes"));
    if (!list)
        list = json_array();
    char now[32];
    sb_timestamp(now);
    json_t *object = json_object();
    json_object_set_new(object, "process", json_integer(params->process));
    json_object_set_new(object, "started", json_string(params->started));
    json_object_set_new(object, "written", json_string(now));
    json_object_set_new(object, "complete", json_boolean(params->complete));
    json_object_set_new(object, "machine", sb_machine_json());
    json_object_set_new(object, "environment", sb_environment_json());
    json_object_set_new(object, "timers", sb_audit_json(params->driver));
    json_array_append_new(list, object);
    return list;
}

json_t *sb_record_make(const struct sb_record_params *params, const json_t *earlier)
{
    const struct sb_suite *suite = params->suite;
    json_t *run = json_object();
    json_object_set_new(run, "shadebench", json_string(SB_VERSION));
    json_object_set_new(run, "suite", json_string(suite->name));
    json_object_set_new(run, "about", json_string(suite->about ? suite->about : ""));
    json_object_set_new(run, "arguments", json_deep_copy(params->arguments));
    json_object_set_new(run, "program_cache",
                        params->program_cache ? json_string(params->program_cache)
                                              : json_null());
    json_object_set_new(run, "measure", sb_settings_json(&suite->measure));
    json_object_set_new(run, "caps", sb_caps_json(&params->driver->caps));
    json_object_set_new(run, "precision", sb_precision_json(params->driver));
    json_object_set_new(run, "processes", processes_json(params, earlier));
    json_object_set_new(run, "entries", entries_json(params));
    return run;
}
