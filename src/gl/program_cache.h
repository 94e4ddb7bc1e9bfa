// A program cache: a folder of program binaries, a file each (job/program_file.h), keyed by driver
// and sources. What is missing, damaged, of another driver or refused by this one is compiled, and
// its file written anew. The first file that is rejected and the first that cannot be written are
// told by a warning; neither ends anything.
#pragma once

#include "gl/program.h"
#include "job/job.h"

struct sb_gl_program_cache;

// Makes the folder where there is none. A driver that gives no binaries, and a folder that cannot
// be made, are told by a warning, and give NULL: no cache.
struct sb_gl_program_cache *sb_gl_program_cache_open(const char *dir,
                                                     const struct sb_caps *caps);
void sb_gl_program_cache_close(struct sb_gl_program_cache *cache); // NULL: nothing

// As sb_gl_program_make, or loaded: then program->cached is set, compile_ms is 0, and link_ms is
// the time from opening the file until the driver's status was known. What keeping a binary takes is
// in neither. `cache` NULL: sb_gl_program_make.
bool sb_gl_program_cached(struct sb_gl_program_cache *cache,
                          const struct sb_program *source, struct sb_gl_program *program);
