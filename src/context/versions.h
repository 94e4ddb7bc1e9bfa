// The GL versions that every context asks for, newest first: a driver may answer a
// request with exactly that version, so asking for the oldest could lose timers and
// formats.
#pragma once

#include <stdbool.h>

struct sb_gl_version {
    int major, minor;
};

// Ends with {0, 0}. The last is the oldest that shadebench can use.
const struct sb_gl_version *sb_gl_versions(bool gles);

// "OpenGL core 3.3 or newer", for messages.
const char *sb_gl_wanted(bool gles);
