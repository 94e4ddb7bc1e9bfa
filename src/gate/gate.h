// The regression gate: two sides of one plan, base and head, drawn and timed side by side. Are
// head's pictures right, and is it slower than a tolerance? stats/gate.h judges the times.
//
// The sides are two shader folders, two plans (variants), or two environments. Pairs of batches
// alternate (base head, head base) in one process; where the environments differ, in two workers.
#pragma once

#include <jansson.h>

#include "gate/metric.h"
#include "measure/driver.h"
#include "results/gate_row.h"
#include "stats/gate.h"
#include "suite/suite.h"

enum sb_side { SB_BASE, SB_HEAD, SB_SIDES };
extern const char *const sb_side_names[SB_SIDES]; // "base", "head"

struct sb_gate_side_params {
    const char *shaders;          // folder; NULL: data_dir/shaders
    const struct sb_suite *suite; // entry i of base goes with entry i of head
    struct sb_driver_params driver;
    bool renamed; // every name that can be is another (glsl/rename.h)
    // Every pair has this program on this side, with the variant of the suite's first entry.
    const struct sb_frozen *frozen; // NULL: none
};

struct sb_gate_params {
    struct sb_gate_side_params side[SB_SIDES];
    bool apart; // the sides' drivers differ: a process each
    // Variants whose final sources are equal on both sides are timed all the same.
    bool keep_equal;
    // Frames of the sides cost differently: each side has a batch of its own length.
    bool own_batches;
    // All variants get confirm_pairs pairs, and no verdict: what is wanted is the bias.
    bool selftest;
    struct sb_gate_rule
        rule; // of all variants; `variants` is set to those that are timed
    enum sb_metric metric;
    const struct sb_measure_settings *settings; // budget, seed, batch, batch_ms
    const char *data_dir;
    const char *dir;         // results folder
    const json_t *arguments; // of the command line, for gate.json; borrowed
};

struct sb_gate_counting {          // metric instructions
    struct sb_caps caps[SB_SIDES]; // of the processes that count
    char other_code[600];          // sb_gate_other_code
    double repeatability; // of the variant that repeats worst (stats/counts.h); NAN: none
    int counts;           // of both sides of all variants, and …
    int apart;            // … how many stand apart from those they should repeat, …
    double farthest;      // … the farthest by so much
};

// In words, what of the code that a JIT makes may differ between a process that is timed and one
// whose instructions are counted: "the code counted is not the code timed: callgrind hides avx512f";
// empty where nothing of it is known.
void sb_gate_other_code(const struct sb_caps *timed, const struct sb_caps *counted,
                        char *words, size_t size);

struct sb_gate_result {
    struct sb_gate_row *row; // one a plan entry
    int row_count;
    int count[SB_GATE_VERDICT_COUNT]; // rows of each verdict
    enum sb_metric metric;            // that was used; never SB_METRIC_AUTO
    struct sb_gate_rule rule;
    struct sb_gate_bias bias; // selftest
    bool bias_incomplete;     // of fewer pairs than planned: it says nothing
    struct sb_gate_counting counting;
    struct sb_caps caps[SB_SIDES];
    const char *timer; // the metric's source: that of GL, or the clock
    double seconds;    // all of it
    double median_mde; // over the variants that were timed; NAN: none was
    bool interrupted;
    int exit_code;               // the worst of the rows
    struct sb_gate_state *state; // keeps what the rows point to
};

// False when nothing could be compared, or the results could not be written; in the latter case
// the rows are there all the same. *result must be zeroed; free also after failure.
bool sb_gate_run(const struct sb_gate_params *params, struct sb_gate_result *result,
                 struct sb_error *err);
// The batches of a row's pairs by the metric, in the order of measuring: row->pairs values.
const double *sb_gate_values(const struct sb_gate_result *result, int row,
                             enum sb_side side);
void sb_gate_result_free(struct sb_gate_result *result);
