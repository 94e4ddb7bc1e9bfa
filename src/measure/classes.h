// Equivalence classes: variants that differ in implementation axes only must draw the same
// picture. Every variant of a plan is drawn once and compared with the first of its class;
// nothing is timed, and one picture is kept at a time.
#pragma once

#include "measure/task.h"

struct sb_classes_params {
    const struct sb_suite *suite;
    const struct sb_driver *driver; // sb_driver_connect is enough
    const char *data_dir, *shaders;
};

struct sb_class {
    int first;          // the entry that the others are compared with; -1: none was drawn
    int members, drawn; // entries, and those of them that were drawn
    bool exact;         // they must agree; else the difference is only told
    double spread; // largest difference to the first; NAN where one or none was drawn
    enum sb_status status; // the worst of its members', but for those out of reach
};

struct sb_class_member { // of one plan entry
    int class;           // place in sb_classes.row
    enum sb_status
        status;    // SB_OVER_LIMIT: this driver cannot have it, which is no failure
    char *note;    // why it is not SB_OK; NULL: it is
    int same_code; // an earlier entry of the class with an equal program binary; -1
    uint64_t binary_hash;
};

struct sb_classes {
    struct sb_class *row; // in the order of their first entries
    int count;
    struct sb_class_member *member; // one a plan entry
    int compared;                   // pairs of pictures
    int exit_code;                  // the worst
    struct sb_arena arena;
};

// *classes must be zeroed; free also after use.
void sb_classes_verify(const struct sb_classes_params *params,
                       struct sb_classes *classes);
void sb_classes_free(struct sb_classes *classes);

// What tells a class from the others: the id of its first entry, without implementation axes
// and without what all entries of the plan were given alike; "base" where nothing is left.
void sb_class_name(const struct sb_suite *suite, const struct sb_plan_entry *entry,
                   struct sb_text *text);
