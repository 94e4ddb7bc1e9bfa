// Variables of an environment: "NAME=VALUE" sets, "NAME" unsets; of two of a name the later counts.
#pragma once

struct sb_arena;

void sb_environment_apply(const char *const *setting, int count); // to this process's own

// This process's with those settings, for another one: ends with NULL.
char **sb_environment_with(const char *const *setting, int count, struct sb_arena *arena);
