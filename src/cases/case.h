// The hard cases: inputs at which lighting formulas lose their accuracy, each with the formula as
// textbooks print it (naive), the form that holds (robust), and how good it has to be. One table,
// one file a family; the catalogue with its sources is docs/cases.md.
#pragma once

#include "cases/points.h"
#include "measure/driver.h"

enum sb_case_form { SB_CASE_NAIVE, SB_CASE_ROBUST, SB_CASE_FORM_COUNT };
extern const char *const sb_case_form_names[SB_CASE_FORM_COUNT];

// What a case is asked in. HALF: mediump as the driver does it, where that is proven to be half
// precision; EMULATED: every operation rounded to binary16, anywhere (docs/accuracy.md).
enum sb_case_precision {
    SB_CASE_HIGHP,
    SB_CASE_HALF,
    SB_CASE_EMULATED,
    SB_CASE_FIXED, // emulated 10-bit fixed point: what lowp may be
    SB_CASE_PRECISION_COUNT
};
struct sb_case_precision_row {
    const char *name;  // "highp", "mediump", "fp16", "fixed10"
    const char *given; // axis assignments
    bool half;         // inputs are rounded to binary16, and its bounds hold
};
extern const struct sb_case_precision_row sb_case_precisions[SB_CASE_PRECISION_COUNT];
enum { // sets of precisions
    SB_IN_HIGHP = 1 << SB_CASE_HIGHP,
    SB_IN_HALF = 1 << SB_CASE_HALF | 1 << SB_CASE_EMULATED,
    SB_IN_FIXED = 1 << SB_CASE_FIXED,
};
enum { SB_IN_FRAGMENT = 1, SB_IN_VERTEX = 2 }; // sets of stages

// --- how good it has to be ----------------------------------------------------------------

// What is measured. Errors are against the double reference on the same floats, and the largest
// over the points; a value that is not finite is infinitely wrong.
enum sb_figure {
    SB_FIGURE_NONE,
    SB_FIGURE_FINITE, // count: NaN and infinite values in raw terms and colour, and negative radiance
    SB_FIGURE_ABSOLUTE, // steps of 1/255: largest |error|; over max(|right|, 1) where the case is HDR
    SB_FIGURE_RELATIVE, // largest |error| / |right|
    SB_FIGURE_ANGLE,    // degrees between the vector and the right one
    SB_FIGURE_RISES, // count: neighbours in order of which the term rises instead of falls
    SB_FIGURE_LEAKS,  // steps of 1/255: largest value where the right one is exactly 0
    SB_FIGURE_EXCESS, // steps of 1/255: by how much the largest value exceeds 1
    SB_FIGURE_FLIPS,  // percent: points of which a branch went another way
    SB_FIGURE_OWN,    // what the case's own `run` says
    SB_FIGURE_COUNT
};
struct sb_figure_row {
    const char *name, *unit, *help;
};
extern const struct sb_figure_row sb_figure_rows[SB_FIGURE_COUNT];

// Of which value: a term of the lights (enum sb_term of measure/explain.h), or one of these.
enum { SB_OF_COLOUR = -1, SB_OF_NORMAL = -2, SB_OF_VIEW = -3 };

struct sb_criterion {
    enum sb_figure figure;
    int of;
    double highp,
        half; // bounds: measured <= bound passes; NAN: does not cover that precision
};
enum { SB_CRITERION_MAX = 4 };

// --- a case -------------------------------------------------------------------------------

// Where a case runs.
struct sb_case_env {
    const struct sb_axes *axes;
    const struct sb_driver *driver; // probed; its timer may be -1
    const char *data_dir, *shaders;
};

// What a case is asked in, and what the points are for.
struct sb_case_setting {
    enum sb_case_form form;
    enum sb_case_precision precision;
    bool vertex;                      // lit per vertex
    const struct sb_variant *variant; // resolved
};

enum sb_verdict {
    SB_VERDICT_PASS,
    SB_VERDICT_FAIL,
    SB_VERDICT_REFUSED, // the input is turned away, with a message, before it reaches a shader
    SB_VERDICT_NA,      // cannot be asked here; the note says why
    SB_VERDICT_COUNT
};
extern const char *const sb_verdict_names[SB_VERDICT_COUNT];

struct sb_outcome {
    enum sb_verdict verdict;
    enum sb_figure figure; // of the criterion that failed, or came nearest to it …
    int of;
    double measured, bound; // … and what it says; NAN: nothing to measure
    int point;              // where; -1: nowhere in particular
    struct sb_text note;    // what a reader should know
};

// A case that scales: how far it holds.
struct sb_scale {
    const char *name, *unit; // "distance", "units"
    double from, to;         // from where it is easy to where it is hard: logarithmic
    // Appends the points that are asked at x.
    void (*points)(struct sb_points *points, const struct sb_case_setting *setting,
                   double x);
};

struct sb_case {
    const char *id;      // of the catalogue: "light-on-surface"
    const char *help;    // one line: what goes wrong
    const char *formula; // what is on trial
    const char *source;  // who found it
    // Axis assignments, "point=1 attenuation=none": of both forms, and of each over these.
    const char *given, *form[SB_CASE_FORM_COUNT];
    unsigned precisions, stages; // sets; 0: of neither, it runs once
    struct sb_criterion criterion[SB_CRITERION_MAX];
    bool hdr;          // absolute errors count over max(|right|, 1)
    bool keeps_inputs; // they are not rounded to binary16: their rounding is on trial
    // The inputs, as points of a table …
    void (*points)(struct sb_points *points, const struct sb_case_setting *setting);
    // … or whatever else it takes: pictures, the upload path, the compiler. Sets *outcome, whose
    // `figure` and `bound` may be those of `criterion`. False: it could not be asked at all.
    bool (*run)(const struct sb_case_env *env, const struct sb_case *it,
                const struct sb_case_setting *setting, struct sb_outcome *outcome,
                struct sb_error *err);
    struct sb_scale scale; // name NULL: none
    const char
        *holds;  // why the naive form passes here too; NULL: it should not everywhere
    bool on_cpu; // the catalogue's remedy is on the CPU: `refused` passes
    // Assignments over all, of the variant whose ideal is right where a form asks for another
    // picture; NULL: the form's own, as always with a scale.
    const char *right;
};

struct sb_case_family {
    const char *name, *help;
    const struct sb_case *row;
    int count;
};
enum { SB_CASE_FAMILIES = 8 };
extern const struct sb_case_family *const sb_case_families[SB_CASE_FAMILIES];
// The families' tables: distance.c, vectors.c, specular.c, cones.c, area.c, shadows.c,
// accumulation.c; and relations.c, which needs no reference.
extern const struct sb_case_family sb_cases_distance, sb_cases_vectors, sb_cases_specular,
    sb_cases_cones, sb_cases_area, sb_cases_shadows, sb_cases_accumulation,
    sb_cases_relations;

// The case called `id` and its family; an unknown id fails with the nearest ones.
const struct sb_case *sb_case_expect(const char *id, const struct sb_case_family **family,
                                     struct sb_error *err);
int sb_case_total(void);

// The cases that a word stands for: the id of one, or the name of a family. Appends them to `it`, which
// has room for SB_CASES_MAX, each once. An unknown word fails with the nearest and the families.
enum { SB_CASES_MAX = 128 };
bool sb_cases_select(const char *word, const struct sb_case **it, int *count,
                     struct sb_error *err);

// --- asking one ---------------------------------------------------------------------------

// The variant that a case is asked with: its assignments, then the precision's, then the form's
// (so that a form may keep single terms in highp), resolved. `more`: axis assignments that go over
// all of these; NULL: none.
bool sb_case_variant(const struct sb_case_env *env, const struct sb_case *it,
                     enum sb_case_form form, enum sb_case_precision precision,
                     bool vertex, const char *more, struct sb_variant *variant,
                     struct sb_error *err);

// Can this driver be asked in that precision? Else why not, in a sentence.
const char *sb_case_unavailable(const struct sb_case_env *env,
                                enum sb_case_precision precision, bool vertex);

// Asks a case once. The outcome's note is the caller's to free. Never fails: what cannot be asked
// is SB_VERDICT_NA, and what is broken SB_VERDICT_FAIL, with the reason.
void sb_case_ask(const struct sb_case_env *env, const struct sb_case *it,
                 enum sb_case_form form, enum sb_case_precision precision, bool vertex,
                 struct sb_outcome *outcome);

// Asks the case's criteria about points of the caller's instead of its own (breaking points, search,
// inputs that are not in the catalogue).
bool sb_case_ask_points(const struct sb_case_env *env, const struct sb_case *it,
                        const struct sb_case_setting *setting, struct sb_points *points,
                        struct sb_outcome *outcome, struct sb_error *err);
