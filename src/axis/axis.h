// Axes: everything that may differ between two variants, one row each.
//
// The built-in rows stand in axes.def and nowhere else; rows that a suite declares are the
// same struct behind them. Parser, --help, `list`, ids, CSV columns and GLSL constants
// iterate over the table. Only the layers scene, effects, reference, assemble, render and
// cases may name a built-in axis.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "base/text.h"

enum sb_axis_kind {
    SB_PLATFORM,       // where: API, context, driver; never ranked against each other
    SB_SCENE,          // what is asked for: changes the picture that is right
    SB_QUALITY,        // how well: trades time for error
    SB_IMPLEMENTATION, // how: must not change the picture
    SB_AXIS_KIND_COUNT
};
extern const char *const sb_axis_kind_names[SB_AXIS_KIND_COUNT];

enum {
    SB_TODO = 1,    // in the table, but refused: "not implemented yet"
    SB_UNTIMED = 2, // accuracy only: rows carry no time
    SB_WHOLE = 4,   // a number axis that takes whole numbers only
    SB_APART =
        8, // a quality axis, or values of one, whose rows are not ranked against others'
    SB_OPTION = 32, // an option of the command line, too, as platform axes are
    SB_TRUTH = 16,  // a scene axis that is quality where the scene's truth is analytic
};

struct sb_value { // one word of a choice axis; its number is its place in the list
    const char *name;
    const char *text; // right-hand side of the #define; "": the number
    const char *sets; // shorthand: "p_position=highp p_vector=mediump"; "": none
    const char *help;
    unsigned flags;
};

struct sb_axis {
    const char *name;   // the word in suites, --set and ids, and the CSV column
    const char *define; // at most one; "": workload or shorthand, nothing in the GLSL
    const char *when; // "spot>0": elsewhere moot: takes init, prints empty, not in the id
    const char *needs; // "storage=ubo_std140": elsewhere all but init is an error
    const char *help;
    enum sb_axis_kind kind;
    unsigned flags;
    const struct sb_value *values; // NULL: a number in [min, max]
    int value_count;
    double init, min, max; // init of a choice axis: a place in `values`
};

// SB_AXIS_POINT and so on: the place of a built-in axis in every table; and the places of
// the values of choice axes, SB_STAGE_VERTEX and so on.
enum sb_axis_id {
#define VALUE(...)
#define CHOICE(id, ...) SB_AXIS_##id,
#define NUMBER(id, ...) SB_AXIS_##id,
#include "axis/axes.def"
#undef CHOICE
#undef NUMBER
#undef VALUE
    SB_AXIS_BUILTIN_COUNT
};
#define VALUE(id, ...) SB_##id,
#define NUMBER(...)
#define CHOICE(id, name, kind, define, when, needs, init, help, ...)                     \
    enum { __VA_ARGS__ SB_##id##_VALUE_COUNT };
#include "axis/axes.def"
#undef CHOICE
#undef NUMBER
#undef VALUE

#define SB_AXIS_MAX 96
#define SB_NAME_MAX 63 // bytes in the name of an axis or a value

struct sb_axes { // built-in rows first, so an sb_axis_id indexes every table
    struct sb_axis row[SB_AXIS_MAX];
    int count;
};

// The built-in table; copy it, then sb_axes_add.
const struct sb_axes *sb_axes_builtin(void);

// Appends a row; the strings (none NULL) stay the caller's and must outlive the table.
// Refuses a name or define that is taken or is no C identifier, a define that GLSL
// reserves, words that conditions and ids could not hold, init out of range, more rows
// than SB_AXIS_MAX, and a `when` or `needs` that does not parse. Those may name earlier
// rows only, so one pass in table order settles what is moot.
bool sb_axes_add(struct sb_axes *axes, const struct sb_axis *row, struct sb_error *err);

// Do its words stand for values of other axes? Those then say the same, and more.
bool sb_axis_is_shorthand(const struct sb_axis *axis);

// Place of the axis called `name`, or -1.
int sb_axes_find(const struct sb_axes *axes, const char *name);

// As sb_axes_find, but an unknown name fails with the nearest and all valid names.
int sb_axes_expect(const struct sb_axes *axes, const char *name, struct sb_error *err);

// Place of the value called `name` in a choice axis, or -1.
int sb_axis_value_find(const struct sb_axis *axis, const char *name);

// As sb_axis_value_find, but an unknown name fails with the nearest and all valid names.
int sb_axis_value_expect(const struct sb_axis *axis, const char *name,
                         struct sb_error *err);

// Reads `word` as a number for `name`: finite, in [min, max], whole if `whole`. The
// failure says which of these it is not, and what would be valid.
bool sb_number_read(const char *name, const char *word, double min, double max,
                    bool whole, double *value, struct sb_error *err);
