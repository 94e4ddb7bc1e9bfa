// JUnit XML, as CI services read it: suites of cases that passed, failed, could not be judged
// or were skipped.
// The schema is that of Ant's junitreport task, as Jenkins documents it.
#pragma once

#include "base/error.h"
#include "base/text.h"

enum sb_junit_outcome {
    SB_JUNIT_PASSED,
    SB_JUNIT_FAILED,
    SB_JUNIT_ERROR,
    SB_JUNIT_SKIPPED,
    SB_JUNIT_OUTCOMES
};

struct sb_junit_case {
    const char *class_name, *name;
    enum sb_junit_outcome outcome;
    const char *type;    // of a failure or an error: "finite"; NULL: that word
    const char *message; // of a failure or an error, or why it was skipped; NULL: none
    const char *output;  // what it has to say besides (system-out); NULL: nothing
    const char
        *details; // text of a failure or an error, of several lines; NULL: the message
};
struct sb_junit_suite {
    const char *name;
    const struct sb_junit_case *row;
    int count;
};
struct sb_junit_property {
    const char *name, *value;
};
struct sb_junit {
    const char *name;
    const struct sb_junit_suite *suite;
    int count;
    const struct sb_junit_property *property; // of each suite
    int property_count;
};

// XML 1.0 in UTF-8. Texts may be any bytes: what XML cannot hold, not even as a reference (control
// characters, U+FFFE, U+FFFF, bytes that are no UTF-8), becomes U+FFFD.
void sb_junit_text(const struct sb_junit *junit, struct sb_text *text);

// Replaces the file. SB_WRITE_FAILED.
bool sb_junit_write(const struct sb_junit *junit, const char *path, struct sb_error *err);
