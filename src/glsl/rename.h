// The same program with other names: every function, parameter and local variable is called
// something else, and nothing that the API or the linker asks for by name. A compiler makes the
// same of both, but no cache that compares texts takes one for the other.
#pragma once

// A copy of final GLSL in which each such name has "r_" in front; free(). Names that a macro could
// make of others, that stand behind a dot, or that are declared outside of functions stay.
char *sb_glsl_rename(const char *text);
