// GL entry points and what the driver can do. glad's pointers are global: one context a
// process at a time.
#pragma once

#include <glad/gl.h>

#include "base/error.h"
#include "job/job.h"

// Loads the entry points of the current context and fills *caps (all but caps->context).
// `proc` returns NULL for unknown names.
bool sb_gl_load(void (*(*proc)(void *self, const char *name))(void), void *self,
                bool gles, struct sb_caps *caps, struct sb_error *err);

// The first error since the last call as a word ("GL_OUT_OF_MEMORY"), or NULL; clears
// all.
const char *sb_gl_error(void);

// Waits until everything issued has been executed, by reading one pixel of the
// framebuffer bound for reading back (none where that is 0) and glFinish. glFinish alone
// was seen to return early (zink on lavapipe).
void sb_gl_drain(void);
