// What was measured, in forms that other programs read: one writer for each format, behind one
// table.
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "stats/order.h"

enum sb_export_outcome {
    SB_EXPORT_PASSED,
    SB_EXPORT_FAILED,  // measured, and found wanting: a regression
    SB_EXPORT_ERROR,   // not valid, or not to be had: there is no time to believe
    SB_EXPORT_SKIPPED, // nothing can be said: not measured, inconclusive
    SB_EXPORT_OUTCOMES
};

struct sb_export_counter { // a figure besides the times: "max_err"
    const char *name;      // letters, digits and _
    double value;          // NAN: none; left out
};

// One measured thing: a variant of a run, or a side of a pair. Everything is borrowed.
// A number that is not known is NAN, and not what a zeroed struct has.
struct sb_export_row {
    const char *scene, *variant; // "room" and its id; with `side` they are unique
    // Of a pair, "base" or "head"; NULL: of a run. What is judged of a pair stands in its head;
    // of a base nothing is read but times, samples and counters.
    const char *side;
    enum sb_export_outcome outcome;
    const char *status;          // a word: "ok", "regression", "inconclusive"
    const char *message;         // what a reader should know, in one line; NULL: nothing
    const char *details;         // lines for the text of a failure; NULL: the message
    struct sb_interval frame_ns; // a frame by the timer source; NAN where not known
    double cpu_ns;               // CPU time of the process a frame; NAN: not known
    struct sb_interval ratio;    // head over base, or the row over the first of its scene
    int batch;                   // frames a sample; 0: not known
    // A frame, one a valid sample, in the order of measuring. cpu: NULL, or NANs among them.
    const double *sample_ns, *sample_cpu_ns;
    // Where instructions were counted and nothing was timed: the same of them, and their level is
    // the counter `instructions`. NULL: not counted.
    const double *sample_instructions;
    int sample_count;
    bool equal; // of a head: base is the same program, so nothing was measured
    const struct sb_export_counter *counter;
    int counter_count;
};

// All numbers NAN and all texts NULL: what rows without a measurement begin with.
extern const struct sb_export_row sb_export_row_unknown;

enum sb_export_property_type { SB_EXPORT_TEXT, SB_EXPORT_NUMBER, SB_EXPORT_NUMBERS };
enum {
    SB_EXPORT_HEAD = 1, // a reader wants it beside the results
    SB_EXPORT_ONCE = 2, // of this run alone: others are compared with it all the same
};
struct sb_export_property {
    const char *name;  // a-z, 0-9 and _; Google Benchmark's if it has one: num_cpus
    const char *value; // one line; of NUMBERS with blanks between them. NULL: left out
    enum sb_export_property_type type;
    unsigned flags;
};

struct sb_export {
    const char *name; // of the whole: "shadebench run lights"
    const struct sb_export_property *property;
    int property_count;
    const struct sb_export_row *row;
    int row_count;
};

struct sb_export_format {
    const char *name, *help;
    void (*write)(const struct sb_export *export, struct sb_text *text);
};
extern const struct sb_export_format sb_export_formats[];
extern const int sb_export_format_count;

// SB_USAGE with the nearest word and all that are valid; `owner` is who asks, "--write".
const struct sb_export_format *sb_export_format_find(const char *owner, const char *word,
                                                     struct sb_error *err);

// To a file that is replaced whole, or, where `path` is no regular file, into it: a pipe, a
// terminal, /dev/null. SB_WRITE_FAILED.
bool sb_export_write(const struct sb_export *export,
                     const struct sb_export_format *format, const char *path,
                     struct sb_error *err);

// Appends the markdown to the file that $GITHUB_STEP_SUMMARY names: the page of a job. Without
// the variable nothing is done. SB_WRITE_FAILED.
bool sb_export_step_summary(const struct sb_export *export, struct sb_error *err);
