// A suite as read, before it is multiplied out. Everything lives in the suite's arena.
#pragma once

#include "suite/suite.h"
#include "suite/values.h"
#include "suite/yaml.h"

struct sb_dimension { // an axis and the values it takes
    int axis;
    const double *value;
    int count;
};
struct sb_dimensions {
    struct sb_dimension row[SB_AXIS_MAX];
    int count;
};

struct sb_draft {
    const char *origin;       // stands before messages about the suite as a whole
    const char *preset;       // its name; NULL: none
    struct sb_variant base;   // given: by the suite and the command line,
    uint64_t preset_given[2]; // and by the preset
    struct sb_dimensions sweep, cross;
    const char *const *exclude, *const *scene;
    int exclude_count, scene_count;
};

// Whether `root` has only keys that a suite, or a preset, may have. The parts of a suite have
// the keys of a plan only.
bool sb_draft_keys(const struct sb_yaml *root, bool preset, struct sb_error *err);

// Adds the axes that `root` declares to suite->axes.
bool sb_draft_axes(const struct sb_yaml *root, struct sb_suite *suite,
                   struct sb_error *err);

// Reads name, about and measure into `suite`, over what is there.
bool sb_draft_head(const struct sb_yaml *root, struct sb_suite *suite,
                   struct sb_error *err);

// Reads `expect:` into `suite`, whose axes are complete.
bool sb_draft_expect(const struct sb_yaml *root, struct sb_suite *suite,
                     struct sb_error *err);

// A text or a list of texts, none of them empty, appended to (*list, *count).
bool sb_draft_texts(const struct sb_yaml *node, const char *what, struct sb_arena *arena,
                    const char *const **list, int *count, struct sb_error *err);

// The values of an axis, a word, a range or a list of them, appended to `values`.
bool sb_draft_values(const struct sb_yaml *node, const struct sb_axes *axes, int axis,
                     struct sb_values *values, struct sb_error *err);

// Reads the keys of a plan, of a preset, a suite or a part, into `draft`, over what is there.
bool sb_draft_read(const struct sb_yaml *root, struct sb_suite *suite,
                   struct sb_draft *draft, struct sb_error *err);

// --set, --sweep and --cross: each axis first loses the values that the file gives it in
// sweep and cross.
bool sb_draft_assign(const struct sb_suite_params *params, struct sb_suite *suite,
                     struct sb_draft *draft, struct sb_error *err);

// Appends to suite->entry.
bool sb_draft_expand(const struct sb_draft *draft, struct sb_suite *suite,
                     struct sb_error *err);

// A name that can stand in a path or a column: letters, digits, - and _.
bool sb_suite_name_valid(const char *name);

// The id of an entry: a preset is told by its name, not by all that it sets.
void sb_entry_id(const struct sb_axes *axes, const char *preset,
                 const struct sb_variant *v, struct sb_text *id);
