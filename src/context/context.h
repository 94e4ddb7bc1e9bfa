// Contexts: one file each, one row each in the list, probed in that order. Libraries are
// opened with dlopen, so that a missing one disables its own context and nothing else. No
// file here sees glad.
#pragma once

#include "base/error.h"

typedef void (*sb_proc)(void);

struct sb_context_options {
    bool gles;  // OpenGL ES 3.0 or newer; else desktop core profile, 3.3 or newer
    int device; // EGL device number; -1: default. Context egl only: others refuse it
};

struct sb_context_fns {
    const char *name, *help;
    void *(*open)(const struct sb_context_options *,
                  struct sb_error *); // current on return
    void (*close)(void *self);        // NULL is allowed
    sb_proc (*proc)(void *self, const char *name);
    void (*present)(void *self);  // optional: a window
    bool (*software)(void *self); // optional: does it say that a CPU draws?
};

extern const struct sb_context_fns sb_context_egl, sb_context_glfw, sb_context_osmesa;
extern const struct sb_context_fns *const sb_contexts[]; // in probe order, ends with NULL

// Opens the named context, or with "auto" the first of the list that opens; *fns says
// which. SB_NO_GL tells for every context tried why it did not open; an unknown name
// (SB_USAGE) lists the valid ones.
void *sb_context_open(const char *name, const struct sb_context_options *options,
                      const struct sb_context_fns **fns, struct sb_error *err);
