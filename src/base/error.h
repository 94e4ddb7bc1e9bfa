// Errors: a status word from status.def and one line for a human, made where the cause is.
//
// A function that can fail takes a `struct sb_error *` last and returns false or NULL; its
// callers add nothing and pass the failure on. The line says what is wrong, where it
// stands, and what would be valid.
#pragma once

#include <stdbool.h>

enum sb_status {
#define STATUS(id, word, code, help) SB_##id,
#include "base/status.def"
#undef STATUS
    SB_STATUS_COUNT
};

struct sb_status_row {
    const char *word;
    int exit_code;
    const char *help;
};

struct sb_error {
    enum sb_status status;
    char text[1024];
};

extern const struct sb_status_row sb_status_rows[SB_STATUS_COUNT];

// Fills *err (NULL: nothing is kept) and returns false, for `return sb_fail(...)`.
bool sb_fail(struct sb_error *err, enum sb_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// The word's place in the table, or SB_STATUS_COUNT.
enum sb_status sb_status_find(const char *word);

// Of two exit codes the one to end with (the order stands in status.def).
int sb_exit_code_worse(int a, int b);
