// A driver, opened and proven: its caps, which of its timers tells the truth, and what it does
// with precision qualifiers.
#pragma once

#include "job/job.h"

struct sb_driver_params {
    const struct sb_runner_fns *runner;
    struct sb_context_params context;
    // A source's name; NULL or "auto": the first credible one; "none": nothing will be timed.
    const char *timer;
};

struct sb_driver {
    const struct sb_runner_fns *fns;
    void *runner;
    struct sb_caps caps;
    struct sb_audit audit;
    int timer; // place in audit.source
    struct sb_probe probe;
    struct sb_precision_verdict verdict[SB_PRECISION_MAX]; // of each reading
};

// How far a credible timer's reading of a long batch may be from the wall clock.
#define SB_TIMER_TOLERANCE 0.05

// Opens, audits, chooses a timer, probes. SB_NO_TIMER tells of every source why not; a source
// that was asked for by name is used only if it is credible, too. With the timer "none" there is no
// audit, and `timer` is -1.
bool sb_driver_open(const struct sb_driver_params *params, struct sb_driver *driver,
                    struct sb_error *err);
void sb_driver_close(struct sb_driver *driver);
bool sb_driver_untimed(const struct sb_driver_params *params); // the timer is "none"

// Is the job still there? False with why it was given up (job.h, `holds`).
bool sb_driver_holds(const struct sb_driver *driver, uint32_t job, struct sb_error *err);
// Processes that the runner has used so far.
int sb_driver_workers(const struct sb_driver *driver);

// Opens, and asks for nothing but the caps: for whoever draws and does not measure.
// driver->timer is -1.
bool sb_driver_connect(const struct sb_driver_params *params, struct sb_driver *driver,
                       struct sb_error *err);

// Audits a connected driver's timers and uses one of them: by name, or the first credible one (NULL,
// "auto"). SB_NO_TIMER tells why there is none.
bool sb_driver_prove(struct sb_driver *driver, const char *timer, struct sb_error *err);

// Finds out what a connected driver does with precision qualifiers; sb_driver_open has.
bool sb_driver_probe(struct sb_driver *driver, struct sb_error *err);

// As sb_driver_open, but it is no failure that no timer is credible (driver->timer is -1):
// for `probe`, whose business it is to say so.
bool sb_driver_examine(const struct sb_driver_params *params, struct sb_driver *driver,
                       struct sb_error *err);

// The timer of an examined driver, for measuring after all; else why there is none (SB_NO_TIMER).
bool sb_driver_use_timer(struct sb_driver *driver, const char *wanted,
                         struct sb_error *err);

// What a stage makes of a carrier at a precision (0 highp, 1 mediump, 2 lowp); NULL where not
// probed.
const struct sb_precision_verdict *sb_driver_precision(const struct sb_driver *driver,
                                                       bool vertex_stage,
                                                       enum sb_carrier carrier,
                                                       int precision);
