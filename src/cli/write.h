// --write FORMAT=FILE: what a command has measured, for other programs.
#pragma once

#include "cli/options.h"
#include "export/export.h"

// One --write more. SB_USAGE, with the nearest format, where the word is none.
bool sb_outputs_add(struct sb_outputs *outputs, const char *word, struct sb_error *err);

// Is one of the files "-", standard output?
bool sb_outputs_take_stdout(const struct sb_outputs *outputs);

// SB_USAGE where two things are to go to standard output, or the folder of a file is none or cannot
// be written, so that no measurement is lost to a slip. Ask before anything is measured.
bool sb_outputs_check(const struct sb_options *options, struct sb_error *err);

// Writes them all, tells of each that could not be written, and returns the exit code.
int sb_outputs_write(const struct sb_outputs *outputs, const struct sb_export *export);
