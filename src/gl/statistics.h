// What a driver prints of the shaders that it compiles: instructions, registers, spills. Drivers
// say it as debug messages (KHR_debug; GL 4.6, 20.2) whose source is the shader compiler; which of
// them, and in what words, is their own business.
#pragma once

#include "base/text.h"
#include "gl/gl.h"

// Collects into `text`, one message behind the other, until sb_gl_statistics_end; nothing where the
// context has no debug output. Times measured meanwhile hold the printing, too.
void sb_gl_statistics_begin(struct sb_text *text);
void sb_gl_statistics_end(void);
