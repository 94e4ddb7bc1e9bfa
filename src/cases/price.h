// What guards cost: the naive and the robust form of a case as two variants of an ordinary scene,
// timed side by side.
#pragma once

#include <jansson.h>

#include "cases/verify.h"
#include "stats/order.h"
#include "suite/suite.h"

// A pair of programs, of however many cases it is.
struct sb_price {
    struct sb_variant variant[SB_CASE_FORM_COUNT]; // resolved
    bool vertex;
    struct sb_text guards; // the axes that they differ in: "f_unit f_attenuation"
    const struct sb_case *it[SB_CASES_MAX]; // whose forms they are
    int case_count;
    struct sb_interval ratio; // robust over naive, 95 %; NAN: not measured
    struct sb_text note; // statuses of rows that are not "ok", and why there is no time
};
struct sb_prices {
    struct sb_price *row;
    int count, capacity;
    struct sb_text
        unpriced; // a line for every reason why cases have no price, with the cases
    // Of the measuring.
    char timer[64];
    double timer_error;
    bool interrupted;
    int exit_code; // the worst of the rows'
};

// The distinct pairs of the cases: as asked in highp, in the fragment stage where the case has it,
// but with 8 lights of each type that it has, 256 x 256 pixels, and the platform axes of `platform`.
// NULL and 0: all cases. *prices must be zeroed; free it also after failure.
bool sb_prices_find(const struct sb_case_env *env, const struct sb_case *const *it,
                    int count, const struct sb_variant *platform,
                    struct sb_prices *prices, struct sb_error *err);

struct sb_prices_params {
    const struct sb_driver *driver; // examined (sb_driver_examine) …
    const char *timer;              // … and the timer that is wanted; NULL: any
    const char *data_dir, *shaders;
    const char *dir; // results folder of a run of its own
    const char *scene;
    double seed, rounds, budget; // of its rounds, and seconds for them at most
    const json_t *arguments;     // for run.json
};
// Measures all pairs in the rounds of one run of one process. A pair's interval is over its paired
// rounds (stats/paired.h). False: nothing could be measured.
bool sb_prices_measure(struct sb_prices *prices, const struct sb_prices_params *params,
                       struct sb_error *err);

// Hands the prices to the robust highp cells that they are of.
void sb_prices_apply(const struct sb_prices *prices, struct sb_matrix *matrix);
void sb_prices_free(struct sb_prices *prices);
