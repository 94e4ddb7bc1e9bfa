#include <string.h>

#include "base/log.h"
#include "base/text.h"
#include "base/words.h"
#include "measure/driver.h"

// The source that is wanted: by name, or the first credible one; -1: there is none.
static int pick(const struct sb_audit *audit, const char *wanted)
{
    if (!wanted || strcmp(wanted, "auto") == 0)
        return audit->chosen;
    for (int i = 0; i < audit->source_count; i++)
        if (strcmp(audit->source[i].name, wanted) == 0)
            return audit->source[i].credible ? i : -1;
    return -1;
}

// The audit is a measurement too: another process may have had the cores for a while, so
// a verdict of "none" is read again, twice, before it is believed.
static bool audit(struct sb_driver *driver, const char *wanted, struct sb_error *err)
{
    for (int attempt = 0; attempt < 3; attempt++) {
        if (!driver->fns->audit(driver->runner, &driver->audit, err))
            return false;
        sb_audit_judge(&driver->audit, SB_TIMER_TOLERANCE);
        driver->timer = pick(&driver->audit, wanted);
        if (driver->timer >= 0)
            break;
        sb_debug("no timer source that is wanted was credible; the audit is read again");
    }
    return true;
}

static bool no_timer(const struct sb_audit *audit, struct sb_error *err)
{
    struct sb_text why = {0};
    for (int i = 0; i < audit->source_count; i++)
        sb_text_printf(&why, "%s%s: %s", i ? "; " : "", audit->source[i].name,
                       audit->source[i].usable ? audit->source[i].reason : "not there");
    sb_fail(err, SB_NO_TIMER, "no timer source passed its audit (%s)", sb_text_get(&why));
    sb_text_free(&why);
    return false;
}

// Says why driver->timer is -1.
static bool explain_timer(const struct sb_driver *driver, const char *wanted,
                          struct sb_error *err)
{
    const struct sb_audit *audit = &driver->audit;
    const char *names[SB_TIMER_MAX];
    if (!wanted || strcmp(wanted, "auto") == 0)
        return no_timer(audit, err);
    for (int i = 0; i < audit->source_count; i++) {
        const struct sb_timer_source *source = &audit->source[i];
        names[i] = source->name;
        if (strcmp(source->name, wanted) == 0)
            return sb_fail(
                err, SB_NO_TIMER, "timer \"%s\" did not pass its audit: %s", wanted,
                source->usable ? source->reason : "the driver does not have it");
    }
    return sb_fail_unknown(err, "", "timer", wanted, names, audit->source_count);
}

bool sb_driver_connect(const struct sb_driver_params *params, struct sb_driver *driver,
                       struct sb_error *err)
{
    *driver = (struct sb_driver){.fns = params->runner, .timer = -1};
    driver->runner = params->runner->open(&params->context, &driver->caps, err);
    return driver->runner != NULL;
}

bool sb_driver_probe(struct sb_driver *driver, struct sb_error *err)
{
    if (!driver->fns->probe(driver->runner, &driver->probe, err))
        return false;
    for (int i = 0; i < driver->probe.count; i++)
        sb_precision_judge(&driver->probe.reading[i], &driver->verdict[i]);
    return true;
}

static bool examine(const struct sb_driver_params *params, bool timed,
                    struct sb_driver *driver, struct sb_error *err)
{
    if (!sb_driver_connect(params, driver, err))
        return false;
    if ((!timed || audit(driver, params->timer, err)) && sb_driver_probe(driver, err))
        return true;
    sb_driver_close(driver);
    return false;
}

bool sb_driver_examine(const struct sb_driver_params *params, struct sb_driver *driver,
                       struct sb_error *err)
{
    return examine(params, true, driver, err);
}

bool sb_driver_use_timer(struct sb_driver *driver, const char *wanted,
                         struct sb_error *err)
{
    if (driver->timer < 0)
        return explain_timer(driver, wanted, err);
    return driver->fns->use_timer(driver->runner, driver->timer, err);
}

bool sb_driver_untimed(const struct sb_driver_params *params)
{
    return params->timer && strcmp(params->timer, "none") == 0;
}

bool sb_driver_open(const struct sb_driver_params *params, struct sb_driver *driver,
                    struct sb_error *err)
{
    const bool timed = !sb_driver_untimed(params);
    if (!examine(params, timed, driver, err))
        return false;
    if (!timed || sb_driver_use_timer(driver, params->timer, err))
        return true;
    sb_driver_close(driver);
    return false;
}

bool sb_driver_prove(struct sb_driver *driver, const char *timer, struct sb_error *err)
{
    return audit(driver, timer, err) && sb_driver_use_timer(driver, timer, err);
}

void sb_driver_close(struct sb_driver *driver)
{
    if (driver->runner)
        driver->fns->close(driver->runner);
    driver->runner = NULL;
}

bool sb_driver_holds(const struct sb_driver *driver, uint32_t job, struct sb_error *err)
{
    return !driver->fns->holds || driver->fns->holds(driver->runner, job, err);
}

int sb_driver_workers(const struct sb_driver *driver)
{
    return driver->fns->workers ? driver->fns->workers(driver->runner) : 1;
}

const struct sb_precision_verdict *sb_driver_precision(const struct sb_driver *driver,
                                                       bool vertex_stage,
                                                       enum sb_carrier carrier,
                                                       int precision)
{
    for (int i = 0; i < driver->probe.count; i++) {
        const struct sb_precision_reading *reading = &driver->probe.reading[i];
        if (reading->vertex_stage == vertex_stage && reading->carrier == carrier &&
            reading->precision == precision)
            return &driver->verdict[i];
    }
    return NULL;
}
