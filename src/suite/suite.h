// Suites: what to run, from YAML or from --set and --sweep, as a list of plan entries.
//
// `sweep` varies its axes one after another, the rest at `base`; `cross` multiplies what
// `sweep` gave by every combination of its values. So `sweep: {point: .., spot: ..}` with
// `cross: {stage: [fragment, vertex]}` is points by stage, then spots by stage. The
// entries are in that order, the last axis of `cross` fastest, scene after scene.
//
//     suite: lights                      letters, digits, - and _
//     about: what does a light cost?
//     scene: containers                  or a list
//     preset: delphi                     bench/presets/delphi.yaml: a suite without preset,
//                                        sweep, cross and parts; this file's keys go over it.
//                                        Or a list: the plan under each, side by side
//     target: 256x256 rgba16f            base's width, height and, if given, target
//     base:  {api: gles}                 axis: value
//     sweep: {point: [0, 1..8 x2]}       axis: value, range (A..B, A..B step S, A..B xF)
//     cross: {stage: [fragment, vertex]} or a list of these
//     exclude: ["stage=vertex,point>4"]  conditions on resolved variants
//     parts:                             plans side by side: each has scene, target, base,
//       - {base: {point: 4}, sweep: ..}  sweep, cross and exclude of its own, which go over
//       - {base: {shadows: 2}, ..}       and beside this file's
//     measure: {budget: 20}              rows of measure.def
//     axes:                              its own; `define` is what the shaders see
//       - {name: taps, kind: quality, define: TAPS, min: 1, max: 16, init: 4, whole: true}
//       - {name: curve, kind: quality, define: CURVE, values: [linear, cubic],
//          init: cubic, when: taps>1, needs: stage=fragment, help: which curve}
//     A value may be a map, too: {name: linear, text: what CURVE expands to, help: ...}.
//     expect:                            what `run --check` judges: a column of summary.csv each
//       - {where: {point: [1, 8], scene: room}, max_err: "<= 2/255", nonfinite: 0}
//
// The id of an entry under a preset begins with the preset's name, and goes on with what was
// given besides: `delphi`, `delphi,stage=vertex`. What the preset itself gives is left out.
#pragma once

#include "axis/variant.h"
#include "base/mem.h"

// How to measure; a field that a suite or the command line does not set keeps the default
// of sb_measure_defaults. One table (measure.def) makes this struct, the YAML keys, the
// command-line options and their help.
struct sb_measure_settings {
#define SETTING(name, init, min, max, whole, help) double name;
#include "suite/measure.def"
#undef SETTING
};
struct sb_measure_row {
    const char *name, *help;
    double init, min, max;
    bool whole;
    size_t offset; // into struct sb_measure_settings
};
extern const struct sb_measure_row sb_measure_rows[];
extern const int sb_measure_row_count;
void sb_measure_defaults(struct sb_measure_settings *settings);
bool sb_measure_set(struct sb_measure_settings *settings, const char *name,
                    const char *value, struct sb_error *err);

struct sb_plan_entry {
    const char *scene;         // "containers"
    const char *preset;        // "delphi"; NULL: none
    struct sb_variant variant; // resolved; given: what stands in the id
    char *id;                  // sb_variant_id of it, behind the name of the preset
};

// One column of an item of `expect:`. What columns there are is not known here: the words are kept
// with where they stood, "file:line:column", for whoever knows.
struct sb_expect_axis { // the row has one of these values, as it was drawn
    int axis;
    const double *value;
    int count;
};
struct sb_expectation {
    const char *const *scene; // of these,
    int scene_count;          // or with 0 of any scene
    const struct sb_expect_axis *axis;
    int axis_count;
    const char *column, *column_at; // "max_err"
    const char *bound, *bound_at;   // "<= 2/255"
};

struct sb_suite {
    const char *name, *about;
    struct sb_axes axes; // built-in rows and the suite's own
    struct sb_measure_settings measure;
    struct sb_plan_entry *entry;
    int entry_count;
    int duplicates; // entries dropped because an equal one stands before them
    int excluded;   // entries dropped by `exclude`
    const struct sb_expectation *expect;
    int expect_count;
    struct sb_arena arena; // owns all of the above
};

// One `axis=value` of --set, or `axis=v1,v2` / `axis=0..32 step 4` of --sweep, --cross.
struct sb_assignment {
    const char *axis, *values;
    const char *origin; // where it stood: "--set stage=vretex", for messages
};

struct sb_suite_params {
    const char *path;   // a YAML file; NULL: no file
    const char *preset; // --preset NAME,…: data_dir/bench/presets/NAME.yaml; NULL: none
    const char *data_dir; // where presets are looked up; NULL: a preset is an error
    const char *scene;    // --scene; NULL: the suite's, else "containers"
    // Over the file's; `set` wins over base.
    const struct sb_assignment *set, *sweep, *cross;
    int set_count, sweep_count, cross_count;
};

// Loads, checks and expands. --set, --sweep and --cross first take their axis out of the
// file's sweep and cross, in all of its parts. At most 10 000 entries, counting those that the
// last plan drops. Errors name file:line:column, the word and the valid words.
// *suite must be zeroed; sb_suite_free also after failure.
bool sb_suite_load(const struct sb_suite_params *params, struct sb_suite *suite,
                   struct sb_error *err);
void sb_suite_free(struct sb_suite *suite);

// Behind each entry puts the same with each other value of a choice axis for which `wanted` says so;
// those that are there already are left out. An axis that is never moot, and that no rule names.
struct sb_vary_params {
    int axis;
    bool (*wanted)(const struct sb_axes *axes, const struct sb_variant *entry,
                   const struct sb_variant *varied);
};
void sb_suite_vary(struct sb_suite *suite, const struct sb_vary_params *params);
